#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/parallel/cancellation.h"
#include "core/parallel/thread_team.h"
#include "core/parallel/time_budget.h"
#include "core/sample_block.h"
#include "core/sample_draw.h"
#include "core/views/prepared_views.h"

#include <vector>

namespace grasp_affordances
{

/// The loop of Algorithm 1: draws samples and examines each of them, with all threads of a team. Samples know nothing
/// of one another: each writes its own result, which does not depend on the number of threads. Keeps its working
/// memory; one instance serves one caller at a time.
class SampleLoop
{
public:
  /// What the loop works on, and with.
  struct Work
  {
    PreparedViews& views;
    const Config& config;
    ThreadTeam& team;
    const TimeBudget& budget;
    const Cancellation& cancellation;
  };

  /// Draws the samples that the parameters ask for, round after round, and examines each round before the next one is
  /// drawn. @throw Cancelled
  void run(const Work& work);

  /// Examines samples at given points, in place of drawn ones. @throw Cancelled
  void examine(const Work& work, const std::vector<PreparedViews::MeasuredPoint>& points);

  /// Where the samples of the last call ended, in their order.
  const std::vector<SampleResult>& results() const { return results_; }

  /// The points that run() drew.
  const SampleDraw& draw() const { return draw_; }

  /// What the last call took: under `preparation` the wall time of estimating normals, under the stages of a sample the
  /// time summed over the threads. The rest is zero.
  const StageTimes& times() const { return times_; }

private:
  void examine(const Work& work, const SampleSpan& span);

  SampleDraw draw_;
  std::vector<SampleBlock> blocks_;    // one per thread
  std::vector<SampleResult> results_;  // one slot per sample
  StageTimes times_;
};

}  // namespace grasp_affordances
