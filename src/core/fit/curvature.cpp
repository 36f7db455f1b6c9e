#include "core/fit/curvature.h"

#include "core/kernels/quadric_curvatures.h"
#include "core/parallel/random.h"
#include "core/result/axis_frame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{
namespace
{

QuadricCoefficients coefficients(const Quadric& quadric)
{
  const Eigen::Matrix3d& A = quadric.A;
  const Eigen::Vector3d& b = quadric.b;
  return {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(1, 2), A(0, 2), b.x(), b.y(), b.z(), quadric.c};
}

/// Writes the local coordinates of `count` points, evenly spaced among the first n of the neighborhood. `phase`, less
/// than n, decides which is the first.
void drawPoints(const Quadric& quadric, const Neighborhood& neighborhood, std::size_t n, std::size_t count,
                std::size_t phase, CurvatureScratch& scratch)
{
  const std::size_t room = (count + kCurvatureBatch - 1) / kCurvatureBatch * kCurvatureBatch;
  if (static_cast<std::size_t>(scratch.points.rows()) < room) {
    scratch.points.resize(static_cast<Eigen::Index>(room), Eigen::NoChange);
  }
  // The j-th point is (j n + phase) / count, without a division.
  std::size_t i = phase / count, rest = phase % count;
  const std::size_t stride = n / count, remainder = n % count;
  // Local copies: the compiler cannot know that the stores below leave the originals alone.
  const double scale = 1.0 / quadric.scale;
  const Eigen::Vector3d origin = quadric.origin;
  const float *from_x = neighborhood.x(), *from_y = neighborhood.y(), *from_z = neighborhood.z();
  double *x = scratch.points.col(0).data(), *y = scratch.points.col(1).data(), *z = scratch.points.col(2).data();
  for (std::size_t j = 0; j < room; ++j) {
    x[j] = (from_x[i] - origin.x()) * scale;
    y[j] = (from_y[i] - origin.y()) * scale;
    z[j] = (from_z[i] - origin.z()) * scale;
    if (j + 1 < count) {
      rest += remainder;
      i += stride + (rest >= count ? 1 : 0);
      rest -= rest >= count ? count : 0;
    }
  }
}

}  // namespace

PrincipalCurvature principalCurvature(const Quadric& quadric, const Eigen::Vector3d& x)
{
  const Eigen::Vector3d gradient = quadric.gradient(x);
  const Eigen::Vector3d normal = gradient.normalized();
  const auto [first, second] = acrossAxis(normal);
  const Eigen::Matrix3d shape = quadric.hessian() / gradient.norm();
  const double a = first.dot(shape * first);
  const double b = first.dot(shape * second);
  const double d = second.dot(shape * second);

  PrincipalCurvature result;
  const double mean = (a + d) / 2, half_difference = (a - d) / 2;
  const double deviation = std::hypot(half_difference, b);
  // The direction of the algebraically larger curvature, or of the smaller one where the mean is negative. It is taken
  // from the row of the shape operator in which nothing cancels.
  const double along_first = half_difference >= 0.0 ? deviation + half_difference : std::abs(b);
  const double along_second = half_difference >= 0.0 ? b : std::copysign(deviation - half_difference, b);
  const Eigen::Vector3d larger = along_first * first + along_second * second;
  const Eigen::Vector3d across = along_first * second - along_second * first;
  const bool negative = mean < 0.0;
  result.value = negative ? mean - deviation : mean + deviation;
  result.axis = deviation > 0.0 ? (negative ? larger : across).normalized() : second;
  return result;
}

std::optional<NeighborhoodCurvature> medianCurvature(const Quadric& quadric, const Neighborhood& neighborhood,
                                                     const SeenFrom& seen, const EvenDraw& draw,
                                                     CurvatureScratch& scratch)
{
  const std::size_t n = std::min(seen.points, neighborhood.size()), drawn = std::min(draw.count, n);
  if (drawn == 0) {
    return std::nullopt;
  }
  drawPoints(quadric, neighborhood, n, drawn, randomIndex(draw.random_bits, static_cast<std::uint32_t>(n)), scratch);
  const auto column = [&](Eigen::Index k) { return scratch.points.col(k).data(); };
  const Eigen::Vector3d local_sensor = quadric.toLocal(seen.sensor.value_or(quadric.origin));
  const CurvatureCounts counts = quadricCurvatures(coefficients(quadric), local_sensor.data(), drawn,
                                                   {column(0), column(1), column(2), column(3)});
  if (counts.valid == 0) {
    return std::nullopt;
  }

  // Points that are not valid have an infinite curvature, and come last.
  double *squared = column(3), *sorted = column(4), *middle = sorted + counts.valid / 2;
  std::copy(squared, squared + drawn, sorted);
  std::nth_element(sorted, middle, sorted + drawn);
  const Eigen::Index median = std::find(squared, squared + drawn, *middle) - squared;
  NeighborhoodCurvature result;
  result.median = std::sqrt(*middle) / quadric.scale;
  result.axis = principalCurvature(quadric, scratch.points.row(median).head<3>().matrix().transpose()).axis;
  result.concave = seen.sensor && 2 * counts.concave > counts.valid;
  return result;
}

}  // namespace grasp_affordances
