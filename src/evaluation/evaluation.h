#pragma once

#include "evaluation/handle_errors.h"
#include "evaluation/judge.h"
#include "evaluation/labelled_cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace grasp_affordances
{

struct JudgedShell
{
  Shell shell;
  Verdict verdict;
  std::string object = {};  ///< of a wrong one: that most points within are of; empty where it is not known
};

struct JudgedHandle
{
  GraspHandle handle;  ///< without its hand poses
  Verdict verdict;
  HandleErrors errors;  ///< of a right one
  std::size_t hand_poses = 0;
  std::string object = {};  ///< as that of a shell
};

/// How a frame is localized in.
struct Variation
{
  Config config;
  std::size_t views = 1;  ///< the frame's first ones
};

/// Numbers of samples, indexed by Outcome.
using OutcomeCounts = std::array<std::uint32_t, kOutcomes>;

/// One call of the localizer.
struct Run
{
  std::vector<JudgedShell> shells;
  std::uint32_t sampled = 0;
  std::vector<JudgedHandle> handles = {};
  std::map<std::uint32_t, OutcomeCounts> ends = {};  ///< by label of an affordance: where the samples on it ended
};

/// Whether a right shell finds the affordance of this label.
bool finds(const Run& run, std::uint32_t label);

/// How many right handles find it.
std::size_t handlesOn(const Run& run, std::uint32_t label);

/// What a further view of a frame shows.
struct ViewCounts
{
  std::uint32_t points = 0;                 ///< measured
  std::vector<std::size_t> visible_points;  ///< per affordance of the frame's result
};

struct FrameResult
{
  std::string group, scene;
  std::uint64_t seed = 0;
  double capture_radius = 0.0;          ///< m, of the hand that its labels hold for
  std::uint32_t points = 0;             ///< measured in the first view
  std::vector<Affordance> affordances;  ///< as the first view shows them; those of which any view shows a point
  std::vector<ViewCounts> further_views;
  std::vector<std::vector<Run>> runs;  ///< per variation
};

std::size_t pointsIn(const FrameResult& frame, std::size_t views);

/// Of an affordance, by its index, in the first so many views together.
std::size_t visiblePoints(const FrameResult& frame, std::size_t affordance, std::size_t views);

/// In that further view which shows most of it.
std::size_t visibleElsewhere(const FrameResult& frame, std::size_t affordance);

/// Localizes in each frame with each variation and judges shells and handles. Run r samples with the seed r, from
/// 1 on; the hand is the one that the frame's labels hold for. Frames are shared out among the threads (0: one per
/// core), with no influence on the result.
///
/// @param done  called after each frame, from one thread at a time
/// @throw what loading a frame throws; std::out_of_range for a variation with more views than a frame has
std::vector<FrameResult> evaluate(const std::vector<EvaluationFrame>& frames, const std::vector<Variation>& variations,
                                  std::size_t runs, std::size_t threads, const std::function<void()>& done);

}  // namespace grasp_affordances
