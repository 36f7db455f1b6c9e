#include "grasp_affordances/localizer.h"

#include "grasp_affordances/circle.h"
#include "grasp_affordances/curvature.h"
#include "grasp_affordances/free_space.h"
#include "grasp_affordances/occlusion.h"
#include "grasp_affordances/principal_axis.h"
#include "grasp_affordances/quadric.h"
#include "grasp_affordances/random.h"
#include "grasp_affordances/sampling.h"
#include "grasp_affordances/shell.h"

#include "core/prepared_cloud.h"
#include "core/thread_team.h"

#include <Eigen/Geometry>

#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The milliseconds since it was made or last asked.
class Stopwatch
{
public:
  double lap()
  {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// What the estimator says of a neighborhood.
struct AxisEstimate
{
  Eigen::Vector3d axis;         // unit
  double curvature = kUnknown;  // 1/m
  bool concave = false;
};

/// The cylinder through a neighborhood, about a given axis.
struct CylinderEstimate
{
  FittedCylinder cylinder;
  bool concave;  // the points lie on the far side of the axis, seen from the sensor
};

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

/// Examines one sample after another with the working memory of one thread.
class SampleKernel
{
public:
  /// The body of Algorithm 1's loop: where sample `i` ends. `shell` is set where it ends as one.
  Outcome examine(const PreparedCloud& prepared, const Config& config, std::uint64_t i, Shell& shell);

  StageTimes times;  // summed over the samples since it was last reset

private:
  void findNeighborhood(const PreparedCloud& prepared, const Config& config, std::uint32_t point);
  bool isOccluded(const PreparedCloud& prepared, const Config& config) const;
  std::optional<AxisEstimate> estimateAxis(const PreparedCloud& prepared, const Config& config,
                                           std::uint64_t random_bits);
  std::optional<CylinderEstimate> fitCylinder(const PreparedCloud& prepared, const Eigen::Vector3d& axis) const;
  Outcome fitShell(const PreparedCloud& prepared, const Config& config, const FittedCylinder& cylinder, Shell& shell);

  Neighborhood neighborhood_;
  CurvatureScratch curvature_scratch_;
  ShellSearch shell_search_;
};

Outcome SampleKernel::examine(const PreparedCloud& prepared, const Config& config, std::uint64_t i, Shell& shell)
{
  Stopwatch stopwatch;
  const std::uint64_t seed = config.sampling.seed;
  const std::uint32_t point = samplePoint(prepared.measured, prepared.candidates, config.sampling, i);

  findNeighborhood(prepared, config, point);
  times.neighborhoods += stopwatch.lap();
  if (neighborhood_.size() < static_cast<std::size_t>(config.neighborhood.min_points)) {
    return Outcome::too_few_points;
  }

  const bool hidden = isOccluded(prepared, config);
  times.occlusion += stopwatch.lap();
  if (hidden) {
    return Outcome::occluded;
  }

  const auto estimate = estimateAxis(prepared, config, randomBits(seed, i, 1));
  times.fit += stopwatch.lap();
  if (!estimate) {
    return Outcome::degenerate;
  }
  if (estimate->curvature < 1.0 / config.hand.capture_radius) {  // false where the estimator measures none
    return Outcome::low_curvature;
  }

  const auto fitted = fitCylinder(prepared, withLargestComponentPositive(estimate->axis));
  times.fit += stopwatch.lap();
  if (!fitted) {
    return Outcome::degenerate;
  }
  if (config.estimation.reject_concave && (estimate->concave || fitted->concave)) {
    return Outcome::concave;
  }

  shell.curvature = estimate->curvature;
  shell.point_index = point;
  const Outcome outcome = fitShell(prepared, config, fitted->cylinder, shell);
  times.shell += stopwatch.lap();
  return outcome;
}

void SampleKernel::findNeighborhood(const PreparedCloud& prepared, const Config& config, std::uint32_t point)
{
  const Eigen::Vector3f center = prepared.cloud.point(point);
  if (config.neighborhood.kind == NeighborhoodKind::knn) {
    prepared.search->nearest(center, static_cast<std::size_t>(config.neighborhood.k), neighborhood_);
  } else {
    const double radius = config.neighborhood.radius > 0.0 ? config.neighborhood.radius : config.hand.capture_radius;
    prepared.search->withinRadius(center, static_cast<float>(radius), neighborhood_);
  }
}

bool SampleKernel::isOccluded(const PreparedCloud& prepared, const Config& config) const
{
  const OcclusionConfig& occlusion = config.occlusion;
  return occlusion.filter && prepared.image &&
         occluded(*prepared.image, neighborhood_, static_cast<std::size_t>(occlusion.max_points_in_front),
                  occlusion.min_distance_in_front);
}

std::optional<AxisEstimate> SampleKernel::estimateAxis(const PreparedCloud& prepared, const Config& config,
                                                       std::uint64_t random_bits)
{
  const EstimationConfig& estimation = config.estimation;
  if (estimation.estimator == Estimator::taubin) {
    const auto fit = fitTaubin(neighborhood_);
    if (!fit) {
      return std::nullopt;
    }
    const auto curvature =
        medianCurvature(fit->quadric, neighborhood_, prepared.sensor,
                        static_cast<std::size_t>(estimation.curvature_points), random_bits, curvature_scratch_);
    return curvature ? std::optional<AxisEstimate>({curvature->axis, curvature->median, curvature->concave})
                     : std::nullopt;
  }
  const auto axis =
      estimation.estimator == Estimator::pca ? pointsAxis(neighborhood_) : normalsAxis(neighborhood_, prepared.normals);
  return axis ? std::optional<AxisEstimate>({*axis}) : std::nullopt;
}

std::optional<CylinderEstimate> SampleKernel::fitCylinder(const PreparedCloud& prepared,
                                                          const Eigen::Vector3d& axis) const
{
  const Eigen::Vector3d first = axis.unitOrthogonal();
  const Eigen::Vector3d second = axis.cross(first);
  const auto circle = fitCircle(neighborhood_, first, second);
  if (!circle) {
    return std::nullopt;
  }
  const Eigen::Vector3d sample = neighborhood_.center.cast<double>();
  CylinderEstimate estimate;
  estimate.cylinder.origin = sample + circle->center.x() * first + circle->center.y() * second;
  estimate.cylinder.axis = axis;
  estimate.cylinder.radius = circle->radius;
  const Eigen::Vector2d to_center = circle->center - circle->mean;
  const Eigen::Vector3d to_sensor = prepared.sensor - sample;
  estimate.concave = to_center.dot(Eigen::Vector2d(to_sensor.dot(first), to_sensor.dot(second))) > 0.0;
  return estimate;
}

Outcome SampleKernel::fitShell(const PreparedCloud& prepared, const Config& config, const FittedCylinder& cylinder,
                               Shell& shell)
{
  const ShellSurroundings surroundings{*prepared.search, prepared.hidden_search.get(),
                                       prepared.image ? &*prepared.image : nullptr,
                                       prepared.spacing(neighborhood_.center.cast<double>())};
  const ShellSearchResult found = shell_search_.search(surroundings, cylinder, config.hand, config.shell);
  if (found.status != ShellSearchResult::found) {
    return found.status == ShellSearchResult::too_short ? Outcome::too_short : Outcome::no_shell;
  }

  shell.axis = cylinder.axis;
  shell.centroid = found.centroid;
  shell.normal = normalTowards(prepared.sensor, found.centroid, cylinder.axis);
  shell.inner_radius = found.inner_radius;
  shell.thickness = config.hand.finger_thickness;
  shell.length = found.length;
  shell.points_inside = found.points_inside;
  shell.points_in_gap = found.points_in_gap;
  shell.observed_free = kUnknown;
  if (!prepared.image) {
    return Outcome::shell;
  }
  shell.observed_free = observedFreeShare(*prepared.image, found, shell.axis, shell.normal, shell.thickness);
  if (config.shell.require_observed_gap && shell.observed_free < config.shell.min_observed_free) {
    return Outcome::unobserved_gap;
  }
  if (config.shell.min_coverage > 0.0 &&
      silhouetteCoverage(*prepared.image, found, shell.axis, shell.normal) < config.shell.min_coverage) {
    return Outcome::uncovered;
  }
  return Outcome::shell;
}

}  // namespace

class Localizer::Implementation
{
public:
  struct SampleResult
  {
    Outcome outcome;
    Shell shell;
  };

  explicit Implementation(const Config& new_config)
      : config(new_config), team(config.threads), kernels(team.size()), samples(config.sampling.samples)
  {
  }

  Config config;
  ThreadTeam team;
  std::vector<SampleKernel> kernels;  // one per thread
  std::vector<SampleResult> samples;  // one slot per sample
};

Localizer::Localizer(const Config& config)
{
  validate(config);
  implementation_ = std::make_unique<Implementation>(config);
}

Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

const Config& Localizer::config() const
{
  return implementation_->config;
}

/// AffordanceFind (Algorithm 1). The samples know nothing of one another: each writes its own slot.
Localization Localizer::localize(const Cloud& cloud)
{
  const Config& config = implementation_->config;
  ThreadTeam& team = implementation_->team;
  auto& kernels = implementation_->kernels;
  auto& samples = implementation_->samples;
  Stopwatch stopwatch, total;
  Localization result;
  const PreparedCloud prepared(cloud, config, team);
  result.warnings = prepared.warnings;
  result.points = static_cast<std::uint32_t>(prepared.measured.size());
  result.threads = static_cast<std::uint32_t>(team.size());
  result.milliseconds.preparation = stopwatch.lap();

  for (SampleKernel& kernel : kernels) {
    kernel.times = StageTimes();
  }
  const std::size_t count = prepared.search ? samples.size() : 0;
  team.forEach(count, [&](std::size_t i, std::size_t member) {
    samples[i].outcome = kernels[member].examine(prepared, config, i, samples[i].shell);
  });

  result.sampled = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    ++result.counts[static_cast<std::size_t>(samples[i].outcome)];
    if (samples[i].outcome == Outcome::shell) {
      result.shells.push_back(samples[i].shell);
    }
  }
  for (const SampleKernel& kernel : kernels) {
    result.milliseconds.neighborhoods += kernel.times.neighborhoods;
    result.milliseconds.occlusion += kernel.times.occlusion;
    result.milliseconds.fit += kernel.times.fit;
    result.milliseconds.shell += kernel.times.shell;
  }
  result.milliseconds.total = total.lap();
  return result;
}

}  // namespace grasp_affordances
