#include "core/sample_block.h"

#include "grasp_affordances/circle.h"
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

std::optional<Outcome> enoughPoints(std::size_t points, const Config& config)
{
  return points >= static_cast<std::size_t>(config.neighborhood.min_points) ? kGoesOn : Outcome::too_few_points;
}

}  // namespace

template <typename Stage>
void SampleBlock::Remaining::pass(Stage&& stage)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    if (const std::optional<Outcome> ended = stage(*samples_[i])) {
      samples_[i]->result->outcome = *ended;
    } else {
      samples_[kept++] = samples_[i];
    }
  }
  size_ = kept;
}

void SampleBlock::examine(const PreparedCloud& prepared, const Config& config, std::uint64_t begin, std::uint64_t end,
                          SampleResult* results)
{
  Remaining all;
  for (std::uint64_t i = begin; i < end; ++i) {
    Sample& sample = samples_[i - begin];
    sample.number = i;
    sample.point = prepared.samplePoint(config, i);
    sample.result = &results[i - begin];
    sample.result->outcome = Outcome::shell;
    all.add(sample);
  }
  // To the letter, with no distance, the filter rejects most samples: then it is worth a look before their points are
  // gathered.
  const bool in_window = prepared.windowSearch() != nullptr && config.neighborhood.kind == NeighborhoodKind::radius;
  const bool looks = in_window && config.occlusion.filter && config.occlusion.min_distance_in_front == 0.0;
  if (looks) {
    look(all, prepared, config);
    filterOccluded(all, prepared, config);
  }
  for (std::size_t first = 0; first < all.size(); first += kFittedAtOnce) {
    Remaining samples;
    for (std::size_t i = first; i < std::min(first + kFittedAtOnce, all.size()); ++i) {
      all[i].neighborhood = &neighborhoods_[i - first];
      samples.add(all[i]);
    }
    findNeighborhoods(samples, in_window, prepared, config);
    if (!looks) {
      filterOccluded(samples, prepared, config);
    }
    Stopwatch stopwatch;
    sumMoments(samples, config);
    if (config.estimation.estimator == Estimator::taubin) {
      estimateCurvatureAxes(samples, prepared, config);
    } else {
      estimatePrincipalAxes(samples, prepared, config);
    }
    fitCylinders(samples, prepared, config);
    times.fit += stopwatch.lap();
    fitShells(samples, prepared, config);
    times.shell += stopwatch.lap();
  }
}

void SampleBlock::look(Remaining& samples, const PreparedCloud& prepared, const Config& config)
{
  Stopwatch stopwatch;
  samples.pass([&](Sample& sample) {
    const Eigen::Vector3f center = prepared.cloud->point(sample.point);
    sample.sphere = prepared.windowSearch()->look(center, PreparedCloud::neighborhoodRadius(config));
    return enoughPoints(sample.sphere.survey.points, config);
  });
  times.neighborhoods += stopwatch.lap();
}

void SampleBlock::findNeighborhoods(Remaining& samples, bool in_window, const PreparedCloud& prepared,
                                    const Config& config)
{
  Stopwatch stopwatch;
  samples.pass([&](Sample& sample) {
    if (in_window) {
      const Eigen::Vector3f center = prepared.cloud->point(sample.point);
      const float radius = PreparedCloud::neighborhoodRadius(config);
      const bool with_index = config.estimation.estimator == Estimator::normals;
      sample.sphere = prepared.windowSearch()->gather(center, radius, with_index, *sample.neighborhood);
    } else {
      prepared.findNeighborhood(sample.point, config, *sample.neighborhood);
      if (prepared.image && config.occlusion.filter) {
        sample.sphere = viewOf(*sample.neighborhood, *prepared.image);
      }
    }
    return enoughPoints(sample.neighborhood->size(), config);
  });
  times.neighborhoods += stopwatch.lap();
}

void SampleBlock::filterOccluded(Remaining& samples, const PreparedCloud& prepared, const Config& config)
{
  if (!config.occlusion.filter || !prepared.image) {
    return;
  }
  Stopwatch stopwatch;
  samples.pass([&](const Sample& sample) {
    const auto enough = static_cast<std::size_t>(config.occlusion.max_points_in_front);
    const bool hidden = occluded(*prepared.image, sample.sphere, enough, config.occlusion.min_distance_in_front);
    return hidden ? Outcome::occluded : kGoesOn;
  });
  times.occlusion += stopwatch.lap();
}

void SampleBlock::sumMoments(Remaining& samples, const Config& config)
{
  const int degree = config.estimation.estimator == Estimator::taubin ? 4 : 3;  // 3: for the circle
  samples.pass([degree](Sample& sample) {
    if (!(sample.neighborhood->radius > 0.0F)) {
      return std::optional<Outcome>(Outcome::degenerate);
    }
    sample.moments = Moments(*sample.neighborhood, degree);
    return kGoesOn;
  });
}

void SampleBlock::estimateCurvatureAxes(Remaining& samples, const PreparedCloud& prepared, const Config& config)
{
  fitter_.clear();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Neighborhood& neighborhood = *samples[i].neighborhood;
    fitter_.add(samples[i].moments, neighborhood.center.cast<double>(), neighborhood.radius);
  }
  fitter_.fit();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].fit = fitter_[i];
  }
  samples.pass([&](Sample& sample) -> std::optional<Outcome> {
    if (!sample.fit) {
      return Outcome::degenerate;
    }
    const auto curvature = medianCurvature(sample.fit->quadric, *sample.neighborhood, prepared.sensor,
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

void SampleBlock::estimatePrincipalAxes(Remaining& samples, const PreparedCloud& prepared, const Config& config)
{
  samples.pass([&](Sample& sample) -> std::optional<Outcome> {
    const auto axis = config.estimation.estimator == Estimator::pca
                          ? pointsAxis(sample.moments)
                          : normalsAxis(*sample.neighborhood, prepared.normals.normals());
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
void SampleBlock::fitCylinders(Remaining& samples, const PreparedCloud& prepared, const Config& config)
{
  samples.pass([&](Sample& sample) -> std::optional<Outcome> {
    sample.axis = withLargestComponentPositive(sample.axis);
    const Eigen::Vector3d first = sample.axis.unitOrthogonal();
    const Eigen::Vector3d second = sample.axis.cross(first);
    const auto circle = fitCircle(sample.moments, sample.neighborhood->radius, first, second);
    if (!circle) {
      return Outcome::degenerate;
    }
    const Eigen::Vector3d center = sample.neighborhood->center.cast<double>();
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

void SampleBlock::fitShells(Remaining& samples, const PreparedCloud& prepared, const Config& config)
{
  samples.pass([&](Sample& sample) { return fitShell(sample, prepared, config); });
}

std::optional<Outcome> SampleBlock::fitShell(Sample& sample, const PreparedCloud& prepared, const Config& config)
{
  const ShellSurroundings surroundings{*prepared.search, prepared.hidden_search ? &*prepared.hidden_search : nullptr,
                                       prepared.image ? &*prepared.image : nullptr,
                                       prepared.spacing(sample.neighborhood->center.cast<double>())};
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
