#pragma once

#include "fuzz/targets.h"
#include "grasp_affordances/cloud.h"

namespace grasp_affordances::fuzz
{

/// What every cloud promises that comes in over a border.
inline void requireWholeCloud(const Cloud& cloud)
{
  const std::size_t points = std::size_t{cloud.width} * cloud.height;
  require(cloud.x.size() == points && cloud.y.size() == points && cloud.z.size() == points,
          "a cloud has width times height points");
  for (std::size_t i = 0; i < points; ++i) {
    const float squared_range = squaredLength(cloud.x[i], cloud.y[i], cloud.z[i]);
    const bool measured = std::isfinite(squared_range) && squared_range > 0.0F;
    const bool blank = std::isnan(cloud.x[i]) && std::isnan(cloud.y[i]) && std::isnan(cloud.z[i]);
    require(measured || blank, "a point is measured, or NaN in all coordinates");
  }
}

}  // namespace grasp_affordances::fuzz
