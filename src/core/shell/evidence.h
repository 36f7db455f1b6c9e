#pragma once

#include <algorithm>

namespace grasp_affordances
{

/// A threshold on a number of points as it is applied: at least 2. Thresholds that follow the density of points become
/// small where points are sparse; but a single point may be noise, and is never evidence.
inline double evidenceThreshold(double points)
{
  constexpr double kFewest = 2.0;
  return std::max(kFewest, points);
}

}  // namespace grasp_affordances
