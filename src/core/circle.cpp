#include "grasp_affordances/circle.h"

#include <Eigen/LU>

#include <cmath>

namespace grasp_affordances
{

std::optional<Circle> fitCircle(const Neighborhood& neighborhood, const Eigen::Vector3d& first,
                                const Eigen::Vector3d& second)
{
  const std::size_t n = neighborhood.size();
  if (n < 3 || !(neighborhood.radius > 0.0F)) {
    return std::nullopt;
  }
  const double scale = 1.0 / neighborhood.radius;
  const Eigen::Vector3d center = neighborhood.center.cast<double>();
  const auto project = [&](std::size_t i) {
    const Eigen::Vector3d p = neighborhood.point(i).cast<double>() - center;
    return Eigen::Vector2d(scale * first.dot(p), scale * second.dot(p));
  };

  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    mean += project(i);
  }
  mean /= n;

  // About the mean the normal equations of equation 4 fall apart: two for the centre, one for the radius.
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  Eigen::Vector2d third = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d q = project(i) - mean;
    scatter += q * q.transpose();
    third += q.squaredNorm() * q;
  }
  const double determinant = scatter(0, 0) * scatter(1, 1) - scatter(0, 1) * scatter(1, 0);
  if (!(determinant > 1e-12 * scatter.trace() * scatter.trace())) {
    return std::nullopt;
  }
  const Eigen::Vector2d offset = 0.5 * (scatter.inverse() * third);
  Circle circle;
  circle.center = (mean + offset) / scale;
  circle.radius = std::sqrt(offset.squaredNorm() + scatter.trace() / n) / scale;
  circle.mean = mean / scale;
  return circle;
}

std::optional<Circle> fitCircleTaubin(const std::vector<Eigen::Vector2d>& points)
{
  if (points.size() < 3) {
    return std::nullopt;
  }
  const auto n = static_cast<double>(points.size());
  Circle circle;
  for (const Eigen::Vector2d& p : points) {
    circle.mean += p / n;
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  Eigen::Vector2d third = Eigen::Vector2d::Zero();
  double fourth = 0.0;
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d q = p - circle.mean;
    const double squared = q.squaredNorm();
    scatter += q * q.transpose() / n;
    third += squared * q / n;
    fourth += squared * squared / n;
  }
  const double variance = scatter.trace(), determinant = scatter.determinant();
  if (!(determinant > 1e-12 * variance * variance)) {
    return std::nullopt;
  }

  // The smallest root of the characteristic polynomial; Newton's method from zero cannot pass it.
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
