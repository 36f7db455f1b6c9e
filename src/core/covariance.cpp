#include "core/covariance.h"

#include <Eigen/Eigenvalues>

namespace grasp_affordances
{

Eigen::Matrix3d covariance(const Neighborhood& neighborhood)
{
  const std::size_t n = neighborhood.size();
  if (n == 0 || !(neighborhood.radius > 0.0F)) {
    return Eigen::Matrix3d::Zero();
  }
  const Eigen::Vector3d center = neighborhood.center.cast<double>();
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double px = neighborhood.x()[i] - center.x();
    const double py = neighborhood.y()[i] - center.y();
    const double pz = neighborhood.z()[i] - center.z();
    x += px, y += py, z += pz;
    xx += px * px, xy += px * py, xz += px * pz;
    yy += py * py, yz += py * pz, zz += pz * pz;
  }
  const Eigen::Vector3d mean = Eigen::Vector3d(x, y, z) / n;
  Eigen::Matrix3d second_moment;
  second_moment << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const double squared_radius = static_cast<double>(neighborhood.radius) * neighborhood.radius;
  return (second_moment / n - mean * mean.transpose()) / squared_radius;
}

std::optional<Eigen::Vector3d> distinctEigenvector(const Eigen::Matrix3d& symmetric, Extreme extreme)
{
  if (!symmetric.allFinite()) {
    return std::nullopt;
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
