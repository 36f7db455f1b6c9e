#include "benchmark/interleaved.h"

#include <algorithm>

namespace grasp_affordances::test
{
namespace
{

double median(const std::vector<StageTimes>& times, double StageTimes::*stage)
{
  std::vector<double> values;
  for (const StageTimes& frame : times) {
    values.push_back(frame.*stage);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

StageTimes medians(const std::vector<StageTimes>& times)
{
  StageTimes result;
  for (const auto stage : {&StageTimes::total, &StageTimes::preparation, &StageTimes::neighborhoods,
                           &StageTimes::occlusion, &StageTimes::fit, &StageTimes::shell}) {
    result.*stage = median(times, stage);
  }
  return result;
}

}  // namespace

std::vector<StageTimes> interleavedMedians(const std::vector<RepeatedFrame>& frames,
                                           const std::function<void(std::size_t, std::size_t)>& round_done)
{
  std::size_t rounds = 0;
  for (const RepeatedFrame& frame : frames) {
    frame.run();
    rounds = std::max(rounds, frame.repetitions);
  }
  std::vector<std::vector<StageTimes>> times(frames.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const std::size_t repetitions = frames[i].repetitions;
      if ((round + 1) * repetitions / rounds > round * repetitions / rounds) {
        times[i].push_back(frames[i].run().milliseconds);
      }
    }
    round_done(round + 1, rounds);
  }
  std::vector<StageTimes> result;
  for (const std::vector<StageTimes>& frame : times) {
    result.push_back(medians(frame));
  }
  return result;
}

}  // namespace grasp_affordances::test
