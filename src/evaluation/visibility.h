#pragma once

#include "simulation/ground_truth.h"

#include <array>
#include <cstddef>
#include <limits>

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

}  // namespace grasp_affordances
