#include "core/fit/circle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>

namespace grasp_affordances
{
namespace
{

/// Mean, covariance and third central moments of points whose moments are known.
struct PointStatistics
{
  explicit PointStatistics(const Moments& moments);

  /// Mean of (p - mean), each weighted with the square of its distance from the axis through the mean.
  Eigen::Vector3d thirdMomentAcross(const Eigen::Vector3d& axis) const;

  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
  std::array<Eigen::Matrix3d, 3> third;  // [c](a, b): mean of the product of the coordinates a, b and c
};

PointStatistics::PointStatistics(const Moments& moments)
{
  const double n = moments.sum(0, 0, 0);
  const auto product = [&](int a, int b = -1, int c = -1) {
    int powers[3] = {};
    for (const int axis : {a, b, c}) {
      if (axis >= 0) {
        ++powers[axis];
      }
    }
    return moments.sum(powers[0], powers[1], powers[2]) / n;
  };
  for (int a = 0; a < 3; ++a) {
    mean[a] = product(a);
  }
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      covariance(a, b) = product(a, b) - mean[a] * mean[b];
    }
  }
  for (int c = 0; c < 3; ++c) {
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        third[c](a, b) = product(a, b, c) - mean[a] * covariance(b, c) - mean[b] * covariance(a, c) -
                         mean[c] * covariance(a, b) - mean[a] * mean[b] * mean[c];
      }
    }
  }
}

Eigen::Vector3d PointStatistics::thirdMomentAcross(const Eigen::Vector3d& axis) const
{
  Eigen::Vector3d result;
  for (int c = 0; c < 3; ++c) {
    result[c] = third[c].trace() - axis.dot(third[c] * axis);
  }
  return result;
}

}  // namespace

std::optional<Circle> fitCircle(const Neighborhood& neighborhood, const Eigen::Vector3d& first,
                                const Eigen::Vector3d& second)
{
  if (neighborhood.size() < 3 || !(neighborhood.radius > 0.0F)) {
    return std::nullopt;
  }
  return fitCircle(Moments(neighborhood), neighborhood.radius, first, second);
}

std::optional<Circle> fitCircle(const Moments& moments, double scale, const Eigen::Vector3d& first,
                                const Eigen::Vector3d& second)
{
  const PointStatistics points(moments);
  const Eigen::Vector3d axis = first.cross(second);
  Eigen::Matrix<double, 2, 3> project;
  project << first.transpose(), second.transpose();

  // About the mean the normal equations of equation 4 fall apart: two for the centre, one for the radius.
  const Eigen::Vector2d mean = project * points.mean;
  const Eigen::Matrix2d scatter = project * points.covariance * project.transpose();
  const Eigen::Vector2d third = project * points.thirdMomentAcross(axis);
  const double determinant = scatter(0, 0) * scatter(1, 1) - scatter(0, 1) * scatter(1, 0);
  if (!(determinant > 1e-12 * scatter.trace() * scatter.trace())) {
    return std::nullopt;
  }
  const Eigen::Vector2d offset = 0.5 * (scatter.inverse() * third);
  Circle circle;
  circle.center = scale * (mean + offset);
  circle.radius = scale * std::sqrt(offset.squaredNorm() + scatter.trace());
  circle.mean = scale * mean;
  return circle;
}

std::optional<Circle> fitCircleTaubin(const PlaneMoments& moments)
{
  if (moments.count < 3) {
    return std::nullopt;
  }
  const double n = moments.count;
  Circle circle;
  circle.mean = Eigen::Vector2d(moments.x, moments.y) / n;

  // Moments about the mean, from those about the origin.
  const Eigen::Vector2d& mean = circle.mean;
  const double squared_mean = mean.squaredNorm(), square = (moments.xx + moments.yy) / n;
  Eigen::Matrix2d products;
  products << moments.xx, moments.xy, moments.xy, moments.yy;
  products /= n;
  const Eigen::Vector2d cubes = Eigen::Vector2d(moments.sx, moments.sy) / n;
  const Eigen::Matrix2d scatter = products - mean * mean.transpose();
  const Eigen::Vector2d third = cubes - square * mean - 2.0 * scatter * mean;
  const double fourth = moments.ss / n - 4.0 * mean.dot(cubes) + 4.0 * mean.dot(products * mean) +
                        2.0 * squared_mean * square - 3.0 * squared_mean * squared_mean;
  const double variance = scatter.trace(), determinant = scatter.determinant();
  if (!(determinant > 1e-12 * variance * variance)) {
    return std::nullopt;
  }

  // The smallest root of the characteristic polynomial. Newton's method starts at zero and cannot pass it.
  const double a3 = 4.0 * variance, a2 = -3.0 * variance * variance - fourth;
  const double a1 = (fourth - variance * variance) * variance + 4.0 * determinant * variance - third.squaredNorm();
  const Eigen::Matrix2d adjoint = variance * Eigen::Matrix2d::Identity() - scatter;
  const double a0 = third.dot(adjoint * third) - (fourth - variance * variance) * determinant;
  double root = 0.0, value = a0;
  constexpr int kMostSteps = 20;
  for (int step = 0; step < kMostSteps; ++step) {
    const double next = root - value / (a1 + root * (2.0 * a2 + root * 3.0 * a3));
    const double next_value = a0 + next * (a1 + next * (a2 + next * a3));
    if (!(std::abs(next_value) < std::abs(value))) {
      break;
    }
    root = next;
    value = next_value;
  }
  const double shifted = root * root - root * variance + determinant;
  const Eigen::Vector2d offset = (adjoint - root * Eigen::Matrix2d::Identity()) * third / (2.0 * shifted);
  circle.center = circle.mean + offset;
  circle.radius = std::sqrt(offset.squaredNorm() + variance);
  return std::isfinite(circle.radius) ? std::optional<Circle>(circle) : std::nullopt;
}

}  // namespace grasp_affordances
