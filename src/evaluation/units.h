#pragma once

#include "evaluation/evaluation.h"

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

struct FrameRun
{
  const FrameResult& frame;
  const Run& run;
};

/// Runs that may depend on one another; those of different units are assumed not to.
using Unit = std::vector<FrameRun>;

/// Each frame with its runs under a variation is a unit or, of a single frame, each run. Refers to the frames.
std::vector<Unit> makeUnits(const std::vector<const FrameResult*>& frames, std::size_t variation);

}  // namespace grasp_affordances
