#include "grasp_affordances/localizer.h"

#include "core/hand_poses/hand_pose_search.h"
#include "core/handles/handle_finder.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/stopwatch.h"
#include "core/parallel/thread_team.h"
#include "core/parallel/time_budget.h"
#include "core/sample_block.h"
#include "core/sample_draw.h"
#include "core/views/prepared_views.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace grasp_affordances
{

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
    blocks.resize(team->size());
    samples.resize(static_cast<std::size_t>(config.sampling.samples));
  }

  /// Examines the samples [begin, end), as long as there is time, and adds what they find. They know nothing of one
  /// another: each writes its own slot.
  void examine(std::size_t begin, std::size_t end, const TimeBudget& budget, Localization& result)
  {
    if (config.estimation.estimator == Estimator::normals) {
      Stopwatch stopwatch;
      views.estimateNormals(config, draw.points() + begin, end - begin, *team, cancellation);
      result.milliseconds.preparation += stopwatch.lap();
    }
    for (SampleBlock& block : blocks) {
      block.times = StageTimes();
    }
    constexpr std::size_t kSize = SampleBlock::kSamples;
    team->forEach((end - begin + kSize - 1) / kSize, [&](std::size_t i, std::size_t member) {
      const std::size_t first = begin + i * kSize, last = std::min(first + kSize, end);
      blocks[member].examine(views, config, first, last, draw.points() + first, &samples[first], budget, cancellation);
    });
    cancellation.check();
    for (std::size_t i = begin; i < end; ++i) {
      ++result.counts[static_cast<std::size_t>(samples[i].outcome)];
      if (samples[i].outcome == Outcome::shell) {
        result.shells.push_back(samples[i].shell);
      }
    }
    result.sampled += static_cast<std::uint32_t>(end - begin);
    for (const SampleBlock& block : blocks) {
      result.milliseconds.neighborhoods += block.times.neighborhoods;
      result.milliseconds.occlusion += block.times.occlusion;
      result.milliseconds.fit += block.times.fit;
      result.milliseconds.shell += block.times.shell;
    }
  }

  Config config;
  Cancellation cancellation;
  std::optional<ThreadTeam> team;
  std::vector<PosedCloud> single;  // a cloud without others
  PreparedViews views;
  SampleDraw draw;
  std::vector<SampleBlock> blocks;    // one per thread
  std::vector<SampleResult> samples;  // one slot per sample
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

/// AffordanceFind (Algorithm 1), and what becomes of its shells.
void Localizer::localize(const std::vector<PosedCloud>& views, Localization& result,
                         const Eigen::Isometry3d& T_workspace_common, const Eigen::Isometry3d& T_approach_common)
{
  Implementation& own = *implementation_;
  Stopwatch stopwatch, total;
  const TimeBudget budget(own.config.sampling.time_budget_ms);
  result.shells.clear();
  result.counts.fill(0);
  result.sampled = 0;
  result.milliseconds = StageTimes();
  own.cancellation.begin();
  own.cancellation.check();
  own.views.update(views, own.config, T_workspace_common, *own.team);
  result.points = own.views.measured;
  result.threads = static_cast<std::uint32_t>(own.team->size());
  result.warnings = own.views.warnings;
  result.nothing_sampled = own.views.nothing_sampled;
  result.view_disagreement = own.views.disagreement;
  result.milliseconds.preparation = stopwatch.lap();

  own.cancellation.check();
  own.draw.start(own.views, own.config);
  for (std::size_t begin = 0; begin < own.draw.size();) {
    const std::size_t end = own.draw.drawRound(own.views, own.config, own.samples.data(), *own.team, own.cancellation);
    own.examine(begin, end, budget, result);
    begin = end;
  }
  stopwatch.lap();
  own.handle_finder.find(own.views, own.config, {own.draw.points(), own.draw.size(), result.shells}, result.handles,
                         own.cancellation);
  result.milliseconds.handles = stopwatch.lap();
  for (GraspHandle& handle : result.handles) {
    own.cancellation.check();
    own.hand_pose_search.search(own.views, own.config, T_approach_common, handle);
  }
  result.milliseconds.hand_poses = stopwatch.lap();
  result.milliseconds.total = total.lap();
}

}  // namespace grasp_affordances
