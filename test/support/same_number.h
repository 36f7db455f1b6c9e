#pragma once

#include <cmath>

namespace grasp_affordances::test
{

/// Equal, or both unknown: NaN.
inline bool sameNumber(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace grasp_affordances::test
