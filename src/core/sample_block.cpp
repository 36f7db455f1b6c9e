#include "core/sample_block.h"

#include "grasp_affordances/free_space.h"
#include "grasp_affordances/occlusion.h"
#include "grasp_affordances/principal_axis.h"
#include "grasp_affordances/random.h"

#include "core/stopwatch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace grasp_affordances
{
namespace
{

constexpr std::optional<Outcome> kGoesOn;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d withLargestComponentPositive(const Eigen::Vector3d& axis)
{
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

/// The part of the direction to the sensor that is at right angles to the axis.
Eigen::Vector3d normalTowards(const Eigen::Vector3d& sensor, const Eigen::Vector3d& centroid,
                              const Eigen::Vector3d& axis)
{
  const Eigen::Vector3d direction = (sensor - centroid).normalized();
  const Eigen::Vector3d across = direction - direction.dot(axis) * axis;
  constexpr double kAlongAxis = 1e-6;  // the sensor looks along the axis: any normal is as good
  return across.norm() > kAlongAxis ? across.normalized() : axis.unitOrthogonal();
}

}  // namespace

void SampleBlock::examine(const PreparedCloud& prepared, const Config& config, std::uint64_t begin, std::uint64_t end,
                          SampleResult* results)
{
  left_count_ = 0;
  for (std::uint64_t i = begin; i < end; ++i) {
    Sample& sample = samples_[i - begin];
    sample.number = i;
    sample.point = prepared.samplePoint(config, i);
    sample.result = &results[i - begin];
    sample.result->outcome = Outcome::shell;
    left_[left_count_++] = &sample;
  }
  Stopwatch stopwatch;
  findNeighborhoods(prepared, config);
  times.neighborhoods += stopwatch.lap();
  filterOccluded(prepared, config);
  times.occlusion += stopwatch.lap();
  sumMoments(config);
  if (config.estimation.estimator == Estimator::taubin) {
    estimateCurvatureAxes(prepared, config);
  } else {
    estimatePrincipalAxes(prepared, config);
  }
  fitCylinders(prepared, config);
  times.fit += stopwatch.lap();
  fitShells(prepared, config);
  times.shell += stopwatch.lap();
}

template <typename Stage>
void SampleBlock::forEachLeft(Stage&& stage)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < left_count_; ++i) {
    if (const std::optional<Outcome> ended = stage(*left_[i])) {
      left_[i]->result->outcome = *ended;
    } else {
      left_[kept++] = left_[i];
    }
  }
  left_count_ = kept;
}

void SampleBlock::findNeighborhoods(const PreparedCloud& prepared, const Config& config)
{
  forEachLeft([&](Sample& sample) {
    prepared.findNeighborhood(sample.point, config, sample.neighborhood);
    const bool enough = sample.neighborhood.size() >= static_cast<std::size_t>(config.neighborhood.min_points);
    return enough ? kGoesOn : Outcome::too_few_points;
  });
}

void SampleBlock::filterOccluded(const PreparedCloud& prepared, const Config& config)
{
  const OcclusionConfig& occlusion = config.occlusion;
  if (!occlusion.filter || !prepared.image) {
    return;
  }
  forEachLeft([&](const Sample& sample) {
    const auto enough = static_cast<std::size_t>(occlusion.max_points_in_front);
    const bool hidden = occluded(*prepared.image, sample.neighborhood, enough, occlusion.min_distance_in_front);
    return hidden ? Outcome::occluded : kGoesOn;
  });
}

void SampleBlock::sumMoments(const Config& config)
{
  const int degree = config.estimation.estimator == Estimator::taubin ? 4 : 3;  // 3: for the circle
  forEachLeft([degree](Sample& sample) {
    if (!(sample.neighborhood.radius > 0.0F)) {
      return std::optional<Outcome>(Outcome::degenerate);
    }
    sample.moments = Moments(sample.neighborhood, degree);
    return kGoesOn;
  });
}

void SampleBlock::estimateCurvatureAxes(const PreparedCloud& prepared, const Config& config)
{
  for (std::size_t begin = 0; begin < left_count_; begin += TaubinFitter::kCapacity) {
    const std::size_t end = std::min(begin + TaubinFitter::kCapacity, left_count_);
    fitter_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Neighborhood& neighborhood = left_[i]->neighborhood;
      fitter_.add(left_[i]->moments, neighborhood.center.cast<double>(), neighborhood.radius);
    }
    fitter_.fit();
    for (std::size_t i = begin; i < end; ++i) {
      left_[i]->fit = fitter_[i - begin];
    }
  }
  forEachLeft([&](Sample& sample) -> std::optional<Outcome> {
    if (!sample.fit) {
      return Outcome::degenerate;
    }
    const auto curvature = medianCurvature(sample.fit->quadric, sample.neighborhood, prepared.sensor,
                                           static_cast<std::size_t>(config.estimation.curvature_points),
                                           randomBits(config.sampling.seed, sample.number, 1), curvature_scratch_);
    if (!curvature) {
      return Outcome::degenerate;
    }
    sample.axis = curvature->axis;
    sample.curvature = curvature->median;
    sample.concave = curvature->concave;
    return curvature->median < 1.0 / config.hand.capture_radius ? Outcome::low_curvature : kGoesOn;
  });
}

void SampleBlock::estimatePrincipalAxes(const PreparedCloud& prepared, const Config& config)
{
  forEachLeft([&](Sample& sample) -> std::optional<Outcome> {
    const auto axis = config.estimation.estimator == Estimator::pca
                          ? pointsAxis(sample.moments)
                          : normalsAxis(sample.neighborhood, prepared.normals.normals());
    if (!axis) {
      return Outcome::degenerate;
    }
    sample.axis = *axis;
    sample.curvature = kUnknown;
    sample.concave = false;
    return kGoesOn;
  });
}

/// The cylinder through each neighborhood, about its axis.
void SampleBlock::fitCylinders(const PreparedCloud& prepared, const Config& config)
{
  forEachLeft([&](Sample& sample) -> std::optional<Outcome> {
    sample.axis = withLargestComponentPositive(sample.axis);
    const Eigen::Vector3d first = sample.axis.unitOrthogonal();
    const Eigen::Vector3d second = sample.axis.cross(first);
    const auto circle = fitCircle(sample.moments, sample.neighborhood.radius, first, second);
    if (!circle) {
      return Outcome::degenerate;
    }
    const Eigen::Vector3d center = sample.neighborhood.center.cast<double>();
    sample.cylinder.origin = center + circle->center.x() * first + circle->center.y() * second;
    sample.cylinder.axis = sample.axis;
    sample.cylinder.radius = circle->radius;

    // Concave: the points lie on the far side of the axis, seen from the sensor.
    const Eigen::Vector2d to_center = circle->center - circle->mean;
    const Eigen::Vector3d to_sensor = prepared.sensor - center;
    const bool far_side = to_center.dot(Eigen::Vector2d(to_sensor.dot(first), to_sensor.dot(second))) > 0.0;
    const bool refused = config.estimation.reject_concave && (sample.concave || far_side);
    return refused ? Outcome::concave : kGoesOn;
  });
}

void SampleBlock::fitShells(const PreparedCloud& prepared, const Config& config)
{
  forEachLeft([&](Sample& sample) { return fitShell(prepared, config, sample); });
}

std::optional<Outcome> SampleBlock::fitShell(const PreparedCloud& prepared, const Config& config, Sample& sample)
{
  const ShellSurroundings surroundings{*prepared.search, prepared.hidden_search ? &*prepared.hidden_search : nullptr,
                                       prepared.image ? &*prepared.image : nullptr,
                                       prepared.spacing(sample.neighborhood.center.cast<double>())};
  const ShellSearchResult found = shell_search_.search(surroundings, sample.cylinder, config.hand, config.shell);
  if (found.status != ShellSearchResult::found) {
    return found.status == ShellSearchResult::too_short ? Outcome::too_short : Outcome::no_shell;
  }

  Shell& shell = sample.result->shell;
  shell.curvature = sample.curvature;
  shell.point_index = sample.point;
  shell.axis = sample.axis;
  shell.centroid = found.centroid;
  shell.normal = normalTowards(prepared.sensor, found.centroid, sample.axis);
  shell.inner_radius = found.inner_radius;
  shell.thickness = config.hand.finger_thickness;
  shell.length = found.length;
  shell.points_inside = found.points_inside;
  shell.points_in_gap = found.points_in_gap;
  shell.observed_free = kUnknown;
  if (!prepared.image) {
    return kGoesOn;
  }
  shell.observed_free = observedFreeShare(*prepared.image, found, shell.axis, shell.normal, shell.thickness);
  if (config.shell.require_observed_gap && shell.observed_free < config.shell.min_observed_free) {
    return Outcome::unobserved_gap;
  }
  if (config.shell.min_coverage > 0.0 &&
      silhouetteCoverage(*prepared.image, found, shell.axis, shell.normal) < config.shell.min_coverage) {
    return Outcome::uncovered;
  }
  return kGoesOn;
}

}  // namespace grasp_affordances
