#include "evaluation/evaluation.h"

#include "evaluation/parallel.h"
#include "grasp_affordances/localizer.h"

#include <algorithm>
#include <mutex>

namespace grasp_affordances
{
namespace
{

Run evaluateRun(const LabelledCloud& labelled, const Judge& judge, Config config, std::size_t run)
{
  config.hand.capture_radius = labelled.capture_radius;
  config.sampling.seed = run + 1;
  config.threads = 1;
  const Localization localization = Localizer(config).localize(labelled.cloud);
  Run result;
  result.sampled = localization.sampled;
  for (const Shell& shell : localization.shells) {
    result.shells.push_back({shell, judge(shell)});
  }
  return result;
}

FrameResult evaluateFrame(const EvaluationFrame& frame, const std::vector<Config>& variations, std::size_t runs)
{
  const LabelledCloud labelled = frame.load();
  FrameResult result;
  result.group = frame.group;
  result.scene = frame.scene;
  result.seed = frame.seed;
  result.capture_radius = labelled.capture_radius;
  for (std::size_t i = 0; i < labelled.cloud.size(); ++i) {
    result.points += labelled.cloud.measured(i) ? 1 : 0;
  }
  for (const Affordance& affordance : labelled.affordances) {
    if (affordance.visible_points > 0) {
      result.affordances.push_back(affordance);
    }
  }
  const Judge judge(labelled.cloud, labelled.labels);
  for (const Config& config : variations) {
    result.runs.emplace_back();
    for (std::size_t run = 0; run < runs; ++run) {
      result.runs.back().push_back(evaluateRun(labelled, judge, config, run));
    }
  }
  return result;
}

}  // namespace

bool finds(const Run& run, std::uint32_t label)
{
  return std::any_of(run.shells.begin(), run.shells.end(),
                     [label](const JudgedShell& judged) { return judged.verdict.affordance == label; });
}

std::vector<FrameResult> evaluate(const std::vector<EvaluationFrame>& frames, const std::vector<Config>& variations,
                                  std::size_t runs, std::size_t threads, const std::function<void()>& done)
{
  std::vector<FrameResult> results(frames.size());
  std::mutex mutex;
  forEachInParallel(frames.size(), threads, [&](std::size_t i) {
    results[i] = evaluateFrame(frames[i], variations, runs);
    const std::lock_guard<std::mutex> lock(mutex);
    done();
  });
  return results;
}

}  // namespace grasp_affordances
