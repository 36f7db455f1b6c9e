#include "grasp_affordances/localization.h"

namespace grasp_affordances
{

const char* outcomeName(Outcome outcome)
{
  static constexpr std::array<const char*, kOutcomes> kNames{
      "too_few_points", "degenerate", "occluded",       "low_curvature", "concave",
      "no_shell",       "too_short",  "unobserved_gap", "uncovered",     "shells"};
  return kNames[static_cast<std::size_t>(outcome)];
}

}  // namespace grasp_affordances
