#pragma once

#include "grasp_affordances/handle.h"

#include <cmath>

namespace grasp_affordances::test
{

/// Half a circle about z in the xy plane, from +x over +y to -x.
inline Polyline halfCircle(double radius, int segments)
{
  Polyline points;
  for (int i = 0; i <= segments; ++i) {
    const double angle = M_PI * i / segments;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  return points;
}

}  // namespace grasp_affordances::test
