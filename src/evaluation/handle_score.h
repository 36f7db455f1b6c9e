#pragma once

#include "evaluation/evaluation.h"
#include "evaluation/statistics.h"
#include "evaluation/visibility.h"

#include <array>
#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Affordances by how many right handles find them, each counted in every run.
struct HandlesPerAffordance
{
  std::size_t none = 0, one = 0, several = 0;
  Interval interval;  ///< of exactlyOne()

  std::size_t affordances() const { return none + one + several; }
  Ratio exactlyOne() const { return {one, affordances()}; }
  Ratio found() const { return {one + several, affordances()}; }
};

/// Of values that are known.
struct Spread
{
  std::size_t count = 0;
  double median = kUndefined;
  double p90 = kUndefined;  ///< nine of ten are below
};

/// What the handles of one variation are like on some frames; units of intervals as those of Score.
struct HandleScore
{
  std::size_t not_counted = 0;
  Ratio precision;    ///< right of right and wrong ones, pooled over all runs
  Interval interval;  ///< of it
  std::array<HandlesPerAffordance, kVisibilityClasses.size()> affordances;

  // Of right handles: see HandleErrors.
  Spread center;                    ///< m
  Spread axis;                      ///< rad
  Spread radius;                    ///< m, of the errors' absolute values
  double radius_bias = kUndefined;  ///< m, median of the errors

  std::size_t wrong() const { return precision.whole - precision.part; }
};

/// @param frames  at least one
HandleScore scoreHandles(const std::vector<const FrameResult*>& frames, std::size_t variation);

}  // namespace grasp_affordances
