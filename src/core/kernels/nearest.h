#pragma once

#include "core/kernels/window_scan.h"

#include <cstddef>

namespace grasp_affordances
{

/// Moves the k points nearest to a centre to the front of the arrays, in their order. Of points at the same distance
/// those that stand first are moved.
/// @param count  number of points
/// @param k  from 1 to count
/// @param squared  working memory for count + kGatherSlack numbers
/// @return the square of the k-th distance (m^2)
float keepNearest(const GatheredPoints& points, std::size_t count, const float center[3], std::size_t k,
                  float* squared);

}  // namespace grasp_affordances
