#include "grasp_affordances/localizer.h"

#include "core/hand_pose_search.h"
#include "core/handle_finder.h"
#include "core/prepared_views.h"
#include "core/sample_block.h"
#include "core/stopwatch.h"
#include "core/thread_team.h"
#include "core/time_budget.h"

#include <algorithm>
#include <optional>
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

  Config config;
  std::optional<ThreadTeam> team;
  std::vector<PosedCloud> single;  // a cloud without others
  PreparedViews views;
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

/// AffordanceFind (Algorithm 1). The samples know nothing of one another: each writes its own slot.
void Localizer::localize(const std::vector<PosedCloud>& posed_clouds, Localization& result,
                         const Eigen::Isometry3d& T_workspace_common, const Eigen::Isometry3d& T_approach_common)
{
  auto& [config, optional_team, single, views, blocks, samples, handle_finder, hand_pose_search] = *implementation_;
  ThreadTeam& team = *optional_team;
  Stopwatch stopwatch, total;
  const TimeBudget budget(config.sampling.time_budget_ms);
  views.update(posed_clouds, config, T_workspace_common, team);
  result.milliseconds = StageTimes();
  result.milliseconds.preparation = stopwatch.lap();

  const std::size_t count = views.hasSamples() ? samples.size() : 0;
  for (SampleBlock& block : blocks) {
    block.times = StageTimes();
  }
  constexpr std::size_t kSize = SampleBlock::kSamples;
  team.forEach((count + kSize - 1) / kSize, [&](std::size_t i, std::size_t member) {
    const std::size_t begin = i * kSize, end = std::min(begin + kSize, count);
    if (budget.spent()) {
      std::for_each(&samples[begin], &samples[begin] + (end - begin),
                    [](SampleResult& sample) { sample.outcome = Outcome::out_of_time; });
      return;
    }
    blocks[member].examine(views, config, begin, end, &samples[begin]);
  });

  result.points = views.measured;
  result.sampled = static_cast<std::uint32_t>(count);
  result.threads = static_cast<std::uint32_t>(team.size());
  result.warnings = views.warnings;
  result.view_disagreement = views.disagreement;
  result.counts.fill(0);
  result.shells.clear();
  for (std::size_t i = 0; i < count; ++i) {
    ++result.counts[static_cast<std::size_t>(samples[i].outcome)];
    if (samples[i].outcome == Outcome::shell) {
      result.shells.push_back(samples[i].shell);
    }
  }
  for (const SampleBlock& block : blocks) {
    result.milliseconds.neighborhoods += block.times.neighborhoods;
    result.milliseconds.occlusion += block.times.occlusion;
    result.milliseconds.fit += block.times.fit;
    result.milliseconds.shell += block.times.shell;
  }
  stopwatch.lap();
  handle_finder.find(views, config, result.shells, result.handles);
  result.milliseconds.handles = stopwatch.lap();
  for (GraspHandle& handle : result.handles) {
    hand_pose_search.search(views, config, T_approach_common, handle);
  }
  result.milliseconds.hand_poses = stopwatch.lap();
  result.milliseconds.total = total.lap();
}

}  // namespace grasp_affordances
