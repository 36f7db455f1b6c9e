#pragma once

#include "evaluation/judge.h"
#include "evaluation/labelled_cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

struct JudgedShell
{
  Shell shell;
  Verdict verdict;
};

/// One call of the localizer.
struct Run
{
  std::vector<JudgedShell> shells;
  std::uint32_t sampled = 0;
};

/// Whether a right shell finds the affordance of this label.
bool finds(const Run& run, std::uint32_t label);

struct FrameResult
{
  std::string group, scene;
  std::uint64_t seed = 0;
  double capture_radius = 0.0;          ///< m, of the hand that its labels hold for
  std::uint32_t points = 0;             ///< measured
  std::vector<Affordance> affordances;  ///< of which the frame shows a point
  std::vector<std::vector<Run>> runs;   ///< per variation
};

/// Localizes in each frame with each variation of the config and judges the shells. Run r samples with the seed r, from
/// 1 on; the hand is the one that the frame's labels hold for. Frames are shared out among the threads (0: one per
/// core), with no influence on the result.
///
/// @param done  called after each frame, from one thread at a time
/// @throw what loading a frame throws
std::vector<FrameResult> evaluate(const std::vector<EvaluationFrame>& frames, const std::vector<Config>& variations,
                                  std::size_t runs, std::size_t threads, const std::function<void()>& done);

}  // namespace grasp_affordances
