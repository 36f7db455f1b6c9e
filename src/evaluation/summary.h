#pragma once

#include "evaluation/evaluation.h"
#include "evaluation/statistics.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Affordances by how well the first view, and the further ones, show them.
struct VisibilityClass
{
  const char* key;    ///< in tables for machines
  const char* title;  ///< in tables for readers
  std::size_t min_points;
  std::size_t max_points;
  double occluded_below;          ///< share; infinite: whatever is in front of it, also where that is unknown
  std::size_t min_elsewhere = 0;  ///< points in the further view that shows most of it

  bool holds(const Affordance& affordance, std::size_t elsewhere) const
  {
    return affordance.visible_points >= min_points && affordance.visible_points <= max_points &&
           (occluded_below == kAny || affordance.occluded_share < occluded_below) && elsewhere >= min_elsewhere;
  }

  static constexpr double kAny = std::numeric_limits<double>::infinity();
  static constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();
};

constexpr std::array<VisibilityClass, 8> kVisibilityClasses{{
    {"all", "all", 1, VisibilityClass::kAnyNumber, VisibilityClass::kAny},
    {"800", "≥ 800 points", 800, VisibilityClass::kAnyNumber, VisibilityClass::kAny},
    {"200", "≥ 200", 200, VisibilityClass::kAnyNumber, VisibilityClass::kAny},
    {"60", "≥ 60", 60, VisibilityClass::kAnyNumber, VisibilityClass::kAny},
    {"200_clear", "≥ 200, less than half occluded", 200, VisibilityClass::kAnyNumber, 0.5},
    {"hidden", "< 60, elsewhere ≥ 200", 0, 59, VisibilityClass::kAny, 200},
    {"hardly_seen", "< 200, elsewhere ≥ 200", 0, 199, VisibilityClass::kAny, 200},
    {"below_800", "< 800", 1, 799, VisibilityClass::kAny},
}};

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

/// One scene, or all of a group, under one variation.
struct SummaryRow
{
  std::string scene;  ///< or the group
  bool is_group = false;
  std::size_t variation = 0;
  Score score;
  std::optional<Mean>
      taubin_difference;  ///< precision of Taubin under the same preset minus this one's, paired by unit
};

/// The scenes in the order of the frames, then the groups of several scenes; for each all variations.
std::vector<SummaryRow> summarize(const Evaluation& evaluation);

}  // namespace grasp_affordances
