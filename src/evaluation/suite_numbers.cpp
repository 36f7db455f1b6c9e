#include "evaluation/suite_numbers.h"

#include "evaluation/handle_score.h"
#include "evaluation/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

constexpr std::string_view kCounted = "200";  // key of the class of affordances that the tables count

std::size_t countedClass()
{
  const auto found = std::find_if(kVisibilityClasses.begin(), kVisibilityClasses.end(),
                                  [](const VisibilityClass& visibility) { return visibility.key == kCounted; });
  return static_cast<std::size_t>(found - kVisibilityClasses.begin());
}

Json share(double value)
{
  return std::isfinite(value) ? Json(value) : Json();
}

Json interval(const Interval& interval)
{
  return std::isfinite(interval.low) ? Json{interval.low, interval.high} : Json();
}

Json handlesJson(const std::vector<const FrameResult*>& frames, std::size_t variation)
{
  const HandleScore score = scoreHandles(frames, variation);
  const HandlesPerAffordance& counts = score.affordances[countedClass()];
  return {{"affordances", counts.affordances()},
          {"one", counts.one},
          {"none", counts.none},
          {"several", counts.several},
          {"exactly_one", share(counts.exactlyOne().value())},
          {"exactly_one_interval", interval(counts.interval)},
          {"right", score.precision.part},
          {"wrong", score.wrong()},
          {"not_counted", score.not_counted},
          {"precision", share(score.precision.value())},
          {"precision_interval", interval(score.interval)}};
}

Json shellsJson(const Score& score)
{
  const Recall& recall = score.recall[countedClass()];
  return {{"affordances", recall.found.whole},
          {"found", recall.found.part},
          {"recall", share(recall.found.value())},
          {"recall_interval", interval(recall.interval)},
          {"right", score.precision.part},
          {"wrong", score.wrong()},
          {"not_counted", score.not_counted},
          {"precision", share(score.precision.value())},
          {"precision_interval", interval(score.interval)}};
}

/// Right and wrong handles by their score, in ten bins.
Json reliabilityJson(const std::vector<const FrameResult*>& frames, std::size_t variation)
{
  constexpr std::size_t kBins = 10;
  struct Bin
  {
    std::size_t right = 0, wrong = 0;
  };
  std::array<Bin, kBins> bins;
  for (const FrameResult* frame : frames) {
    for (const Run& run : frame->runs[variation]) {
      for (const JudgedHandle& judged : run.handles) {
        const double place = std::clamp(judged.handle.score, 0.0, 1.0) * kBins;
        Bin& bin = bins[std::min(static_cast<std::size_t>(place), kBins - 1)];
        bin.right += judged.verdict.kind == Verdict::right ? 1 : 0;
        bin.wrong += judged.verdict.kind == Verdict::wrong ? 1 : 0;
      }
    }
  }
  Json json = Json::array();
  for (std::size_t i = 0; i < kBins; ++i) {
    json.push_back({{"from", static_cast<double>(i) / kBins},
                    {"to", static_cast<double>(i + 1) / kBins},
                    {"right", bins[i].right},
                    {"wrong", bins[i].wrong}});
  }
  return json;
}

/// Where the samples ended on counted affordances that no right handle finds.
Json missedJson(const std::vector<const FrameResult*>& frames, std::size_t variation)
{
  OutcomeCounts sum{};
  std::size_t missed = 0;
  for (const FrameResult* frame : frames) {
    for (const Run& run : frame->runs[variation]) {
      for (const Affordance& affordance : frame->affordances) {
        if (!isCounted(affordance) || handlesOn(run, affordance.label) > 0) {
          continue;
        }
        ++missed;
        const auto ends = run.ends.find(affordance.label);
        for (std::size_t i = 0; i < kOutcomes && ends != run.ends.end(); ++i) {
          sum[i] += ends->second[i];
        }
      }
    }
  }
  return {{"affordances", missed}, {"ends", endsJson(sum)}};
}

}  // namespace

bool isCounted(const Affordance& affordance)
{
  return kVisibilityClasses[countedClass()].holds(affordance, 0);
}

Json endsJson(const OutcomeCounts& ends)
{
  Json json = Json::object();
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    if (ends[i] > 0) {
      json[outcomeName(static_cast<Outcome>(i))] = ends[i];
    }
  }
  return json;
}

Json numbersJson(const std::vector<const FrameResult*>& frames, std::size_t variation)
{
  const Score shells = score(frames, variation, 1);
  return {{"frames", shells.frames},
          {"runs", shells.runs},
          {"handles", handlesJson(frames, variation)},
          {"shells", shellsJson(shells)},
          {"reliability", reliabilityJson(frames, variation)},
          {"missed", missedJson(frames, variation)}};
}

}  // namespace grasp_affordances
