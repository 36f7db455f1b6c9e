#pragma once

#include "evaluation/evaluation.h"
#include "evaluation/handle_score.h"
#include "evaluation/statistics.h"
#include "evaluation/visibility.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Chance that a sample out of `samples`, drawn uniformly from `points`, lands on one of the `visible` ones.
double samplingChance(std::size_t visible, std::size_t points, std::size_t samples);

/// Affordances found, each counted in every run.
struct Recall
{
  Ratio found;
  Interval interval;
  double chance = kUndefined;  ///< mean sampling chance
};

/// Precision and recall of one variation on some frames. The units of its intervals are the frames or, where there is
/// only one, its runs.
struct Score
{
  std::size_t frames = 0;
  std::size_t runs = 0;  ///< per frame
  std::size_t not_counted = 0;
  std::vector<Ratio> units;  ///< right of right and wrong shells
  Ratio precision;           ///< pooled over all runs
  Interval interval;         ///< of the pooled precision
  Mean unit_precision;       ///< over the units with counted shells
  std::array<Recall, kVisibilityClasses.size()> recall;

  std::size_t wrong() const { return precision.whole - precision.part; }
  double wrongPerRun() const { return static_cast<double>(wrong()) / static_cast<double>(frames * runs); }
};

/// @param frames  at least one
/// @param views  of the variation
Score score(const std::vector<const FrameResult*>& frames, std::size_t variation, std::size_t views);

struct Evaluation
{
  std::vector<Variation> variations;
  std::size_t runs = 0;
  std::vector<FrameResult> frames;
};

/// Whether a variation uses more than one view.
bool hasSeveralViews(const Evaluation& evaluation);

/// Whether variations differ in the number of samples or in importance sampling, other than by their preset.
bool variesSampling(const Evaluation& evaluation);

/// One scene, or all of a group, under one variation.
struct SummaryRow
{
  std::string scene;  ///< or the group
  bool is_group = false;
  std::size_t variation = 0;
  Score score;
  HandleScore handles;
  std::optional<Mean>
      taubin_difference;  ///< precision of Taubin under the same preset minus this one's, paired by unit
};

/// The scenes in the order of the frames, then the groups of several scenes; for each all variations.
std::vector<SummaryRow> summarize(const Evaluation& evaluation);

}  // namespace grasp_affordances
