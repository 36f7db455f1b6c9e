#include "core/sample_block.h"

#include "core/fit/circle.h"
#include "core/fit/principal_axis.h"
#include "core/neighborhoods/occlusion.h"
#include "core/parallel/random.h"
#include "core/parallel/stopwatch.h"
#include "core/result/axis_frame.h"
#include "core/shell/free_space.h"

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

/// Unit vector: the part of the direction to the sensor that is at right angles to the axis. NaN where the sensor's
/// place is not known.
Eigen::Vector3d normalTowards(const std::optional<Eigen::Vector3d>& sensor, const Eigen::Vector3d& centroid,
                              const Eigen::Vector3d& axis)
{
  if (!sensor) {
    return unknownNormal();
  }
  const Eigen::Vector3d direction = (*sensor - centroid).normalized();
  constexpr double kAlongAxis = 1e-6;  // the sensor looks along the axis: any normal is as good
  return normalAcross(axis, direction, kAlongAxis);
}

Eigen::Vector3d meanOfFirst(std::size_t count, const Neighborhood& neighborhood)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    sum += neighborhood.point(i).cast<double>();
  }
  return sum / static_cast<double>(count);
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

void SampleBlock::examine(const SampleContext& context, const SampleSpan& span)
{
  const PreparedViews& views = context.views;
  const Config& config = context.config;
  const TimeBudget& budget = context.budget;
  Remaining all;
  spheres_.resize(kSamples * views.size());
  for (std::size_t i = 0; i < span.count; ++i) {
    Sample& sample = samples_[i];
    sample.number = span.first + i;
    sample.point = span.points[i];
    sample.spheres = &spheres_[i * views.size()];
    sample.result = &span.results[i];
    sample.result->outcome = Outcome::shell;
    all.add(sample);
  }
  // Without a distance, as in the paper, the filter rejects most samples. Then it pays to filter before their points
  // are gathered.
  const bool looks = config.occlusion.filter && config.occlusion.min_distance_in_front == 0.0 &&
                     config.neighborhood.kind == NeighborhoodKind::radius && views.allHaveImages();
  if (looks) {
    look(all, views, config, budget);
    filterOccluded(all, views, config);
  }
  for (std::size_t first = 0; first < all.size() && !context.cancellation.wanted(); first += kFittedAtOnce) {
    Remaining samples;
    for (std::size_t i = first; i < std::min(first + kFittedAtOnce, all.size()); ++i) {
      all[i].neighborhood = &neighborhoods_[i - first];
      samples.add(all[i]);
    }
    findNeighborhoods(samples, views, config, budget);
    if (!looks) {
      filterOccluded(samples, views, config);
    }
    Stopwatch stopwatch;
    sumMoments(samples, config);
    if (config.estimation.estimator == Estimator::taubin) {
      estimateCurvatureAxes(samples, views, config);
    } else {
      estimatePrincipalAxes(samples, views, config);
    }
    fitCylinders(samples, views, config);
    times.fit += stopwatch.lap();
    fitShells(samples, views, config, budget);
    times.shell += stopwatch.lap();
  }
}

void SampleBlock::look(Remaining& samples, const PreparedViews& views, const Config& config, const TimeBudget& budget)
{
  Stopwatch stopwatch;
  samples.pass([&](Sample& sample) {
    return budget.spent() ? std::optional<Outcome>(Outcome::out_of_time)
                          : enoughPoints(views.look(sample.point, config, sample.spheres), config);
  });
  times.neighborhoods += stopwatch.lap();
}

void SampleBlock::findNeighborhoods(Remaining& samples, const PreparedViews& views, const Config& config,
                                    const TimeBudget& budget)
{
  Stopwatch stopwatch;
  samples.pass([&](Sample& sample) -> std::optional<Outcome> {
    if (budget.spent()) {
      return Outcome::out_of_time;
    }
    const bool with_index = config.estimation.estimator == Estimator::normals;
    views.gather(sample.point, config, with_index, *sample.neighborhood, sample.spheres, part_);
    return enoughPoints(sample.neighborhood->size(), config);
  });
  times.neighborhoods += stopwatch.lap();
}

void SampleBlock::filterOccluded(Remaining& samples, const PreparedViews& views, const Config& config)
{
  if (!config.occlusion.filter) {
    return;
  }
  Stopwatch stopwatch;
  samples.pass([&](const Sample& sample) {
    return views.occluded(config.occlusion, sample.spheres) ? Outcome::occluded : kGoesOn;
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

void SampleBlock::estimateCurvatureAxes(Remaining& samples, const PreparedViews& views, const Config& config)
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
    const auto curvature = medianCurvature(sample.fit->quadric, *sample.neighborhood,
                                           {views[sample.point.view].sensor, sample.ownPoints()},
                                           {static_cast<std::size_t>(config.estimation.curvature_points),
                                            randomBits(config.sampling.seed, sample.number, 1)},
                                           curvature_scratch_);
    if (!curvature) {
      return Outcome::degenerate;
    }
    sample.axis = curvature->axis;
    sample.curvature = curvature->median;
    sample.concave = curvature->concave;
    return curvature->median < 1.0 / config.hand.capture_radius ? Outcome::low_curvature : kGoesOn;
  });
}

void SampleBlock::estimatePrincipalAxes(Remaining& samples, const PreparedViews& views, const Config& config)
{
  samples.pass([&](Sample& sample) -> std::optional<Outcome> {
    const auto axis = config.estimation.estimator == Estimator::pca
                          ? pointsAxis(sample.moments)
                          : views.normalsAxis(sample.point, *sample.neighborhood, sample.spheres);
    if (!axis) {
      return Outcome::degenerate;
    }
    sample.axis = *axis;
    sample.curvature = kUnknown;
    sample.concave = false;
    return kGoesOn;
  });
}

/// Fits a cylinder about its axis to each neighborhood.
void SampleBlock::fitCylinders(Remaining& samples, const PreparedViews& views, const Config& config)
{
  samples.pass([&](Sample& sample) -> std::optional<Outcome> {
    sample.axis = withLargestComponentPositive(sample.axis);
    const auto [first, second] = acrossAxis(sample.axis);
    const auto circle = fitCircle(sample.moments, sample.neighborhood->radius, first, second);
    if (!circle) {
      return Outcome::degenerate;
    }
    const Eigen::Vector3d center = sample.neighborhood->center.cast<double>();
    sample.cylinder.origin = center + circle->center.x() * first + circle->center.y() * second;
    sample.cylinder.axis = sample.axis;
    sample.cylinder.radius = circle->radius;

    const std::optional<Eigen::Vector3d>& sensor = views[sample.point.view].sensor;
    if (!sensor) {
      return kGoesOn;
    }

    // Concave: the points that the sensor saw lie on the far side of the axis.
    Eigen::Vector2d seen = circle->mean;
    if (sample.ownPoints() < sample.neighborhood->size()) {
      const Eigen::Vector3d offset = meanOfFirst(sample.ownPoints(), *sample.neighborhood) - center;
      seen = {offset.dot(first), offset.dot(second)};
    }
    const Eigen::Vector2d to_center = circle->center - seen;
    const Eigen::Vector3d to_sensor = *sensor - center;
    const bool far_side = to_center.dot(Eigen::Vector2d(to_sensor.dot(first), to_sensor.dot(second))) > 0.0;
    const bool refused = config.estimation.reject_concave && (sample.concave || far_side);
    return refused ? Outcome::concave : kGoesOn;
  });
}

void SampleBlock::fitShells(Remaining& samples, const PreparedViews& views, const Config& config,
                            const TimeBudget& budget)
{
  samples.pass([&](Sample& sample) {
    const std::optional<Outcome> ended =
        budget.spent() ? std::optional<Outcome>(Outcome::out_of_time) : fitShell(sample, views, config);
    if (!ended) {
      Shell& shell = sample.result->shell;
      shell = transformed(shell, views.T_common_view(sample.point.view));
    }
    return ended;
  });
}

std::optional<Outcome> SampleBlock::fitShell(Sample& sample, const PreparedViews& views, const Config& config)
{
  const std::size_t view = sample.point.view;
  const ShellSurroundings surroundings =
      views.surroundings(view, views.spacing(view, sample.neighborhood->center.cast<double>()));
  const ShellSearchResult found = shell_search_.search(surroundings, sample.cylinder, config.hand, config.shell);
  if (found.status != ShellSearchResult::found) {
    return found.status == ShellSearchResult::too_short ? Outcome::too_short : Outcome::no_shell;
  }

  Shell& shell = sample.result->shell;
  shell.curvature = sample.curvature;
  shell.point_index = views.firstPoint(view) + sample.point.point;
  shell.axis = withLargestComponentPositive(found.axis);
  shell.centroid = found.centroid;
  shell.normal = normalTowards(views[view].sensor, found.centroid, shell.axis);
  shell.inner_radius = found.inner_radius;
  shell.thickness = config.hand.finger_thickness;
  shell.length = found.length;
  shell.points_inside = found.points_inside;
  shell.points_in_gap = found.points_in_gap;
  shell.observed_free = kUnknown;
  if (surroundings.image == nullptr) {
    return kGoesOn;
  }
  const RangeImage& image = *surroundings.image;
  shell.observed_free = observedFreeShare(image, found, shell.axis, shell.normal, shell.thickness, surroundings.others);
  if (config.shell.require_observed_gap && shell.observed_free < config.shell.min_observed_free) {
    return Outcome::unobserved_gap;
  }
  if (config.shell.min_coverage > 0.0 &&
      silhouetteCoverage(image, found, shell.axis, shell.normal) < config.shell.min_coverage) {
    return Outcome::uncovered;
  }
  return kGoesOn;
}

}  // namespace grasp_affordances
