#include "core/fit/covariance.h"

#include "core/kernels/moment_sums.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace grasp_affordances
{

namespace
{

/// The unit eigenvector of an extreme eigenvalue that is well apart from the next one. All but the root of a cubic is
/// in closed form, which costs less than half as much as the full decomposition. Empty where the two are not well
/// apart.
std::optional<Eigen::Vector3d> clearEigenvector(const Eigen::Matrix3d& symmetric, Extreme extreme)
{
  // The eigenvalues are mean + scale t with t^3 - 3 t - 2 r = 0 and t in [-2, 2], of which [-2, -1] has the smallest.
  // The largest is the smallest of the negative matrix.
  const double mean = symmetric.trace() / 3.0;
  Eigen::Matrix3d deviator = symmetric;
  deviator.diagonal().array() -= mean;
  deviator *= extreme == Extreme::smallest ? 1.0 : -1.0;
  const double scale = std::sqrt(deviator.squaredNorm() / 6.0);
  const double r = deviator.determinant() / (2.0 * scale * scale * scale);
  // With t = -1 - e: e^3 + 3 e^2 = 2 (1 - r), of which leaving out the cube gives an upper bound.
  double e = std::sqrt(std::max(0.0, (1.0 - r) / 1.5));
  constexpr int kNewtonSteps = 5;
  for (int i = 0; i < kNewtonSteps; ++i) {
    e -= (e * e * (e + 3.0) - 2.0 * (1.0 - r)) / (3.0 * e * (e + 2.0));
  }
  const double t = -1.0 - e;
  const double gap = -1.5 * t - 0.5 * std::sqrt(std::max(0.0, 12.0 - 3.0 * t * t));
  constexpr double kClear = 1e-3;
  if (!(scale * gap > kClear * (std::abs(mean) + 2.0 * scale))) {
    return std::nullopt;
  }

  // The eigenvector is at right angles to all rows of the singular matrix: the product of two that are far from
  // parallel.
  deviator.diagonal().array() -= scale * t;
  const Eigen::Vector3d products[] = {deviator.col(0).cross(deviator.col(1)), deviator.col(1).cross(deviator.col(2)),
                                      deviator.col(2).cross(deviator.col(0))};
  const Eigen::Vector3d& largest =
      *std::max_element(std::begin(products), std::end(products),
                        [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  const Eigen::Vector3d vector = largest.normalized();
  constexpr double kConverged = 1e-13;
  if (!((deviator * vector).norm() <= kConverged * scale)) {
    return std::nullopt;
  }
  return vector;
}

}  // namespace

Eigen::Matrix3d secondMoments(const double* sums)
{
  const double xx = sums[momentIndex(2, 0, 0)], xy = sums[momentIndex(1, 1, 0)], yy = sums[momentIndex(0, 2, 0)];
  const double xz = sums[momentIndex(1, 0, 1)], yz = sums[momentIndex(0, 1, 1)], zz = sums[momentIndex(0, 0, 2)];
  Eigen::Matrix3d matrix;
  matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return matrix;
}

Eigen::Matrix3d covariance(const Neighborhood& neighborhood)
{
  const std::size_t n = neighborhood.size();
  if (n == 0 || !(neighborhood.radius > 0.0F)) {
    return Eigen::Matrix3d::Zero();
  }
  const Eigen::Vector3d center = neighborhood.center.cast<double>();
  const float* const coordinates[] = {neighborhood.x(), neighborhood.y(), neighborhood.z()};
  std::array<double, momentCount(2)> sums;
  sumMoments(coordinates, n, center.data(), sums.data(), 2);
  const Eigen::Vector3d mean = Eigen::Map<const Eigen::Vector3d>(&sums[momentIndex(1, 0, 0)]) / n;
  const double squared_radius = static_cast<double>(neighborhood.radius) * neighborhood.radius;
  return (secondMoments(sums.data()) / n - mean * mean.transpose()) / squared_radius;
}

std::optional<Eigen::Vector3d> distinctEigenvector(const Eigen::Matrix3d& symmetric, Extreme extreme)
{
  if (!symmetric.allFinite()) {
    return std::nullopt;
  }
  if (const auto clear = clearEigenvector(symmetric, extreme)) {
    return clear;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetric);
  const Eigen::Vector3d& values = eigen.eigenvalues();
  const double gap = extreme == Extreme::smallest ? values[1] - values[0] : values[2] - values[1];
  constexpr double kRounding = 1e-13;
  if (eigen.info() != Eigen::Success || !(gap > kRounding * values[2])) {
    return std::nullopt;
  }
  return Eigen::Vector3d(eigen.eigenvectors().col(extreme == Extreme::smallest ? 0 : 2));
}

}  // namespace grasp_affordances
