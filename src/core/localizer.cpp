#include "grasp_affordances/localizer.h"

#include "core/hand_poses/hand_pose_search.h"
#include "core/handles/handle_finder.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/stopwatch.h"
#include "core/parallel/thread_team.h"
#include "core/parallel/time_budget.h"
#include "core/sample_loop.h"
#include "core/views/prepared_views.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// Counts where the samples ended, and lists the shells among them.
void collect(const std::vector<SampleResult>& samples, Localization& result)
{
  result.sampled = static_cast<std::uint32_t>(samples.size());
  for (const SampleResult& sample : samples) {
    ++result.counts[static_cast<std::size_t>(sample.outcome)];
    if (sample.outcome == Outcome::shell) {
      result.shells.push_back(sample.shell);
    }
  }
}

/// m, in the densest view; NaN where a view is a range image.
double pointSpacing(const PreparedViews& views, double radius)
{
  double spacing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t view = 0; view < views.size(); ++view) {
    if (views[view].image) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    spacing = std::fmin(spacing, views[view].spacing(radius));
  }
  return spacing;
}

}  // namespace

class Localizer::Implementation
{
public:
  explicit Implementation(const Config& new_config) { configure(new_config); }

  void configure(const Config& new_config)
  {
    if (!team || new_config.threads != config.threads) {
      team.emplace(new_config.threads);
    }
    config = new_config;
  }

  Config config;
  Cancellation cancellation;
  std::optional<ThreadTeam> team;
  std::vector<PosedCloud> single;  // the one cloud that localize(cloud, ...) was given
  PreparedViews views;
  SampleLoop loop;
  HandleFinder handle_finder;
  HandPoseSearch hand_pose_search;
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

Localization Localizer::localize(const Cloud& cloud)
{
  Localization result;
  localize(cloud, result);
  return result;
}

std::vector<SampleEnd> Localizer::sampleEnds() const
{
  const std::vector<SampleResult>& results = implementation_->loop.results();
  const PreparedViews::MeasuredPoint* points = implementation_->loop.draw().points();
  std::vector<SampleEnd> ends;
  ends.reserve(results.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    ends.push_back({implementation_->views.firstPoint(points[i].view) + points[i].point, results[i].outcome});
  }
  return ends;
}

void Localizer::configure(const Config& config)
{
  validate(config);
  implementation_->configure(config);
}

void Localizer::localize(const Cloud& cloud, Localization& result, const Eigen::Isometry3d& T_workspace_cloud,
                         const Eigen::Isometry3d& T_approach_cloud)
{
  std::vector<PosedCloud>& single = implementation_->single;
  single.assign(1, {&cloud, Eigen::Isometry3d::Identity()});
  localize(single, result, T_workspace_cloud, T_approach_cloud);
}

void Localizer::cancelWhen(std::function<bool()> wanted)
{
  implementation_->cancellation.askInstead(std::move(wanted));
}

/// AffordanceFind (Algorithm 1); then groups its shells into handles, and searches hand poses for these.
void Localizer::localize(const std::vector<PosedCloud>& views, Localization& result,
                         const Eigen::Isometry3d& T_workspace_common, const Eigen::Isometry3d& T_approach_common)
{
  Implementation& own = *implementation_;
  Stopwatch stopwatch, total;
  const TimeBudget budget(own.config.sampling.time_budget_ms);
  result.shells.clear();
  result.counts.fill(0);
  own.cancellation.begin();
  own.cancellation.check();
  own.views.update(views, own.config, T_workspace_common, *own.team);
  result.points = own.views.measured;
  result.threads = static_cast<std::uint32_t>(own.team->size());
  result.warnings = own.views.warnings;
  result.nothing_sampled = own.views.nothing_sampled;
  result.view_disagreement = own.views.disagreement;
  const double preparation = stopwatch.lap();

  own.cancellation.check();
  own.loop.run({own.views, own.config, *own.team, budget, own.cancellation});
  collect(own.loop.results(), result);
  result.milliseconds = own.loop.times();
  result.milliseconds.preparation += preparation;
  stopwatch.lap();
  const SampleDraw& draw = own.loop.draw();
  own.handle_finder.find(own.views, own.config, {draw.points(), draw.size(), result.shells}, result.handles,
                         own.cancellation);
  result.point_spacing = result.handles.empty() ? pointSpacing(own.views, own.config.hand.capture_radius)
                                                : std::numeric_limits<double>::quiet_NaN();
  result.milliseconds.handles = stopwatch.lap();
  for (GraspHandle& handle : result.handles) {
    own.cancellation.check();
    own.hand_pose_search.search(own.views, own.config, T_approach_common, handle);
  }
  result.milliseconds.hand_poses = stopwatch.lap();
  result.milliseconds.total = total.lap();
}

}  // namespace grasp_affordances
