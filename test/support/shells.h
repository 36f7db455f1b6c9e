#pragma once

#include "grasp_affordances/localization.h"

#include <cmath>

namespace grasp_affordances::test
{

/// Whether two shells are the same to the last bit.
inline bool same(const Shell& a, const Shell& b)
{
  const auto bits = [](double x) { return std::isnan(x) ? -1.0 : x; };
  return a.centroid == b.centroid && a.axis == b.axis && a.normal == b.normal && a.inner_radius == b.inner_radius &&
         a.length == b.length && bits(a.curvature) == bits(b.curvature) &&
         bits(a.observed_free) == bits(b.observed_free) && a.points_inside == b.points_inside &&
         a.points_in_gap == b.points_in_gap && a.point_index == b.point_index;
}

}  // namespace grasp_affordances::test
