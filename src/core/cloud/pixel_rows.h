#pragma once

#include "grasp_affordances/cloud.h"

#include "core/cloud/range_image.h"
#include "core/kernels/window_scan.h"

#include <cstddef>

namespace grasp_affordances
{

/// A window of an organized cloud, as the kernels take it.
inline PixelRows pixelRows(const Cloud& cloud, const PixelWindow& window)
{
  PixelRows rows;
  rows.x = cloud.x.data();
  rows.y = cloud.y.data();
  rows.z = cloud.z.data();
  rows.points = cloud.size();
  rows.first = static_cast<std::size_t>(window.v_begin) * cloud.width + static_cast<std::size_t>(window.u_begin);
  rows.rows = static_cast<std::size_t>(window.v_end - window.v_begin);
  rows.columns = static_cast<std::size_t>(window.u_end - window.u_begin);
  rows.stride = cloud.width;
  return rows;
}

}  // namespace grasp_affordances
