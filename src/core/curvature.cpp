#include "grasp_affordances/curvature.h"

#include "grasp_affordances/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace grasp_affordances
{
namespace
{

// Of symmetric [a b; b d]: the eigenvalue of larger magnitude, which has the sign of the trace.
double largerEigenvalue(double a, double b, double d)
{
  const double mean = (a + d) / 2;
  const double deviation = std::hypot((a - d) / 2, b);
  return mean >= 0.0 ? mean + deviation : mean - deviation;
}

// Mean and Gaussian curvature from gradient and Hessian, and from them the larger principal curvature.
double largerCurvature(const Eigen::Matrix3d& hessian, const Eigen::Matrix3d& adjugate, const Eigen::Vector3d& gradient)
{
  const double squared_norm = gradient.squaredNorm();
  const double mean = (squared_norm * hessian.trace() - gradient.dot(hessian * gradient)) /
                      (2 * squared_norm * std::sqrt(squared_norm));
  const double gaussian = gradient.dot(adjugate * gradient) / (squared_norm * squared_norm);
  const double deviation = std::sqrt(std::max(0.0, mean * mean - gaussian));
  return mean >= 0.0 ? mean + deviation : mean - deviation;
}

Eigen::Matrix3d symmetricAdjugate(const Eigen::Matrix3d& m)
{
  Eigen::Matrix3d adjugate;
  adjugate.col(0) = m.col(1).cross(m.col(2));
  adjugate.col(1) = m.col(2).cross(m.col(0));
  adjugate.col(2) = m.col(0).cross(m.col(1));
  return adjugate;
}

}  // namespace

PrincipalCurvature principalCurvature(const Quadric& quadric, const Eigen::Vector3d& x)
{
  const Eigen::Vector3d gradient = quadric.gradient(x);
  const Eigen::Vector3d normal = gradient.normalized();
  const Eigen::Vector3d first = normal.unitOrthogonal();
  const Eigen::Vector3d second = normal.cross(first);
  const Eigen::Matrix3d shape = quadric.hessian() / gradient.norm();
  const double a = first.dot(shape * first);
  const double b = first.dot(shape * second);
  const double d = second.dot(shape * second);

  PrincipalCurvature result;
  result.value = largerEigenvalue(a, b, d);
  // Twice the angle from `first` to the direction of the algebraically larger curvature has tangent 2b / (a - d); the
  // larger one in magnitude lies there or, for a negative trace, at right angles to it.
  const double angle = 0.5 * std::atan2(2 * b, a - d) + (result.value < 0.0 ? M_PI / 2 : 0.0);
  result.axis = std::cos(angle) * second - std::sin(angle) * first;
  return result;
}

std::optional<NeighborhoodCurvature> medianCurvature(const Quadric& quadric, const Neighborhood& neighborhood,
                                                     const Eigen::Vector3d& sensor, std::size_t count,
                                                     std::uint64_t random_bits, CurvatureScratch& scratch)
{
  using Point = CurvatureScratch::Point;
  const Eigen::Vector3d local_sensor = quadric.toLocal(sensor);
  const Eigen::Matrix3d hessian = quadric.hessian();
  const Eigen::Matrix3d adjugate = symmetricAdjugate(hessian);
  const std::size_t n = neighborhood.size();
  const std::size_t drawn = std::min(count, n);
  const std::size_t phase = randomIndex(random_bits, static_cast<std::uint32_t>(std::max<std::size_t>(n, 1)));

  std::vector<Point>& points = scratch.points;
  points.clear();
  std::size_t concave = 0;
  for (std::size_t j = 0; j < drawn; ++j) {
    const std::size_t i = (j * n + phase) / drawn % n;
    Eigen::Vector3d x = quadric.toLocal(neighborhood.point(i).cast<double>());
    Eigen::Vector3d gradient = quadric.gradient(x);
    x -= quadric.value(x) / gradient.squaredNorm() * gradient;
    gradient = quadric.gradient(x);
    const double curvature = largerCurvature(hessian, adjugate, gradient);
    if (!(x.squaredNorm() <= 1.0) || !std::isfinite(curvature)) {
      continue;
    }
    const bool towards_sensor = gradient.dot(local_sensor - x) >= 0.0;
    const bool curves_to_sensor = (curvature < 0.0) == towards_sensor && curvature != 0.0;
    concave += curves_to_sensor ? 1 : 0;
    points.push_back({std::abs(curvature), x});
  }
  if (points.empty()) {
    return std::nullopt;
  }

  const auto median = points.begin() + points.size() / 2;
  std::nth_element(points.begin(), median, points.end(), [](const Point& a, const Point& b) {
    return std::tie(a.magnitude, a.x.x(), a.x.y(), a.x.z()) < std::tie(b.magnitude, b.x.x(), b.x.y(), b.x.z());
  });
  NeighborhoodCurvature result;
  result.median = median->magnitude / quadric.scale;
  result.axis = principalCurvature(quadric, median->x).axis;
  result.concave = 2 * concave > points.size();
  return result;
}

}  // namespace grasp_affordances
