#pragma once

#include "grasp_affordances/localization.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace grasp_affordances::test
{

/// A way to process a frame, and how many times to.
struct RepeatedFrame
{
  std::function<Localization()> run;
  std::size_t repetitions = 1;
};

/// Median times, stage by stage, of each. They take turns, those with fewer repetitions evenly among the others: what
/// else the machine does meanwhile slows all of them alike, so that ratios hold where times do not. Each is called once
/// more at first, to warm up. @param round_done called with the rounds done and their number
std::vector<StageTimes> interleavedMedians(
    const std::vector<RepeatedFrame>& frames,
    const std::function<void(std::size_t, std::size_t)>& round_done = [](std::size_t, std::size_t) {});

}  // namespace grasp_affordances::test
