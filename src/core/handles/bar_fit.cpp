#include "core/handles/bar_fit.h"

#include "core/result/axis_frame.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{
namespace
{

constexpr int kParameters = 6;  // two of the place across the axis, two of the tilt, radius, taper
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;

/// Tukey's biweight: residuals beyond a few standard deviations have no weight.
double weightOf(double residual, double noise)
{
  const double ratio = residual / (4.685 * noise);
  const double rest = 1.0 - ratio * ratio;
  return rest > 0.0 ? rest * rest : 0.0;
}

}  // namespace

std::optional<FittedBar> fitBar(const std::vector<Eigen::Vector3d>& points, const FittedBar& start,
                                const BarPrior& prior, double noise)
{
  const auto [first, second] = acrossAxis(start.axis);
  Parameters deviations;
  deviations << prior.place, prior.place, prior.tilt, prior.tilt, prior.radius, prior.taper;
  const Parameters prior_weights = (noise / deviations.array()).square();
  Parameters change = Parameters::Zero();

  constexpr int kSteps = 8;
  constexpr double kConverged = 1e-6;  // m
  for (int step = 0; step < kSteps; ++step) {
    // Wide at first, so that points count that are near the bar only after some steps.
    const double spread = noise * std::max(1.0, 4.0 - step);
    Normal products = prior_weights.asDiagonal();
    Parameters residuals = -(prior_weights.array() * change.array()).matrix();
    std::size_t near = 0;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d offset = point - start.origin;
      const double along = offset.dot(start.axis);
      const double x = offset.dot(first) - change[0] - change[2] * along;
      const double y = offset.dot(second) - change[1] - change[3] * along;
      const double distance = std::hypot(x, y);
      if (!(distance > 0.0)) {
        continue;
      }
      const double residual = distance - (start.radius + change[4] + (start.taper + change[5]) * along);
      const double weight = weightOf(residual, spread);
      if (weight == 0.0) {
        continue;
      }
      ++near;
      const double u = x / distance, v = y / distance;
      Parameters gradient;
      gradient << u, v, u * along, v * along, 1.0, along;
      products.selfadjointView<Eigen::Lower>().rankUpdate(gradient, weight);
      residuals += weight * residual * gradient;
    }
    if (near < kParameters) {
      return std::nullopt;
    }
    const Parameters correction = products.selfadjointView<Eigen::Lower>().ldlt().solve(residuals);
    if (!correction.allFinite()) {
      return std::nullopt;
    }
    change += correction;
    if (step >= 3 && correction.head<2>().norm() < kConverged && std::abs(correction[4]) < kConverged) {
      break;
    }
  }
  FittedBar bar;
  bar.origin = start.origin + change[0] * first + change[1] * second;
  bar.axis = (start.axis + change[2] * first + change[3] * second).normalized();
  bar.radius = start.radius + change[4];
  bar.taper = start.taper + change[5];
  return bar.radius > 0.0 ? std::optional<FittedBar>(bar) : std::nullopt;
}

}  // namespace grasp_affordances
