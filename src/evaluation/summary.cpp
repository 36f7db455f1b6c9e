#include "evaluation/summary.h"

#include "evaluation/units.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace grasp_affordances
{
namespace
{

std::size_t count(const Unit& unit, Verdict::Kind kind)
{
  std::size_t shells = 0;
  for (const FrameRun& member : unit) {
    for (const JudgedShell& judged : member.run.shells) {
      shells += judged.verdict.kind == kind ? 1 : 0;
    }
  }
  return shells;
}

Recall recallOf(const VisibilityClass& visibility, const std::vector<Unit>& units, std::size_t views)
{
  std::vector<Ratio> ratios;
  double chances = 0.0;
  for (const Unit& unit : units) {
    Ratio ratio;
    for (const FrameRun& member : unit) {
      const auto& [frame, run] = member;
      for (std::size_t i = 0; i < frame.affordances.size(); ++i) {
        if (visibility.holds(frame.affordances[i], visibleElsewhere(frame, i))) {
          ratio += {finds(run, frame.affordances[i].label) ? std::size_t{1} : 0, 1};
          chances += samplingChance(visiblePoints(frame, i, views), pointsIn(frame, views), run.sampled);
        }
      }
    }
    ratios.push_back(ratio);
  }
  const Ratio found = pooled(ratios);
  return {found, pooledInterval(ratios), found.whole > 0 ? chances / static_cast<double>(found.whole) : kUndefined};
}

/// Names with their frames, in the order of first appearance.
using NamedFrames = std::vector<std::pair<std::string, std::vector<const FrameResult*>>>;

NamedFrames framesBy(std::string FrameResult::*name, const std::vector<FrameResult>& frames)
{
  NamedFrames named;
  for (const FrameResult& frame : frames) {
    auto entry =
        std::find_if(named.begin(), named.end(), [&](const auto& other) { return other.first == frame.*name; });
    if (entry == named.end()) {
      entry = named.insert(named.end(), {frame.*name, {}});
    }
    entry->second.push_back(&frame);
  }
  return named;
}

bool hasSeveralScenes(const std::vector<const FrameResult*>& frames)
{
  return std::any_of(frames.begin(), frames.end(),
                     [&](const FrameResult* frame) { return frame->scene != frames.front()->scene; });
}

bool differOnlyInEstimator(const Variation& a, const Variation& b)
{
  const SamplingConfig &sampling_a = a.config.sampling, &sampling_b = b.config.sampling;
  return a.config.preset == b.config.preset && a.views == b.views && sampling_a.samples == sampling_b.samples &&
         sampling_a.importance == sampling_b.importance;
}

/// Sets the differences to Taubin of rows that hold all variations of some frames.
void compareWithTaubin(const std::vector<Variation>& variations, SummaryRow* rows)
{
  for (std::size_t taubin = 0; taubin < variations.size(); ++taubin) {
    if (variations[taubin].config.estimation.estimator != Estimator::taubin) {
      continue;
    }
    for (std::size_t other = 0; other < variations.size(); ++other) {
      if (other != taubin && differOnlyInEstimator(variations[other], variations[taubin])) {
        rows[other].taubin_difference = pairedDifference(rows[taubin].score.units, rows[other].score.units);
      }
    }
  }
}

}  // namespace

double samplingChance(std::size_t visible, std::size_t points, std::size_t samples)
{
  if (points == 0) {
    return 0.0;
  }
  return 1.0 - std::pow(1.0 - static_cast<double>(visible) / static_cast<double>(points), samples);
}

bool hasSeveralViews(const Evaluation& evaluation)
{
  return std::any_of(evaluation.variations.begin(), evaluation.variations.end(),
                     [](const Variation& variation) { return variation.views > 1; });
}

bool variesSampling(const Evaluation& evaluation)
{
  const auto differ = [](const Variation& a, const Variation& b) {
    const SamplingConfig &sampling_a = a.config.sampling, &sampling_b = b.config.sampling;
    return a.config.preset == b.config.preset &&
           (sampling_a.samples != sampling_b.samples || sampling_a.importance != sampling_b.importance);
  };
  return std::any_of(evaluation.variations.begin(), evaluation.variations.end(), [&](const Variation& a) {
    return differ(a, *std::find_if(evaluation.variations.begin(), evaluation.variations.end(),
                                   [&](const Variation& b) { return b.config.preset == a.config.preset; }));
  });
}

Score score(const std::vector<const FrameResult*>& frames, std::size_t variation, std::size_t views)
{
  const std::vector<Unit> units = makeUnits(frames, variation);
  Score result;
  result.frames = frames.size();
  result.runs = frames.front()->runs[variation].size();
  for (const Unit& unit : units) {
    const std::size_t right = count(unit, Verdict::right);
    result.units.push_back({right, right + count(unit, Verdict::wrong)});
    result.not_counted += count(unit, Verdict::not_counted);
  }
  result.precision = pooled(result.units);
  result.interval = pooledInterval(result.units);
  result.unit_precision = meanShare(result.units);
  for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
    result.recall[i] = recallOf(kVisibilityClasses[i], units, views);
  }
  return result;
}

std::vector<SummaryRow> summarize(const Evaluation& evaluation)
{
  std::vector<SummaryRow> rows;
  const auto append = [&](const std::string& name, bool is_group, const std::vector<const FrameResult*>& frames) {
    const std::size_t first = rows.size();
    for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
      rows.push_back({name, is_group, variation, score(frames, variation, evaluation.variations[variation].views),
                      scoreHandles(frames, variation), std::nullopt});
    }
    compareWithTaubin(evaluation.variations, rows.data() + first);
  };
  for (const auto& [scene, frames] : framesBy(&FrameResult::scene, evaluation.frames)) {
    append(scene, false, frames);
  }
  for (const auto& [group, frames] : framesBy(&FrameResult::group, evaluation.frames)) {
    if (!group.empty() && hasSeveralScenes(frames)) {
      append(group, true, frames);
    }
  }
  return rows;
}

}  // namespace grasp_affordances
