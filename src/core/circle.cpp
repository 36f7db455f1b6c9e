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

}  // namespace grasp_affordances
