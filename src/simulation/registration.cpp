#include "simulation/registration.h"

#include "simulation/parallel_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace grasp_affordances
{

MeasuredImage registered(const MeasuredImage& own, const SensorModel& model)
{
  const PinholeIntrinsics& from = model.depth_camera.intrinsics;
  const PinholeIntrinsics& to = model.intrinsics;
  const double scale = to.fx / from.fx;
  MeasuredImage result(model.width, model.height);
  // The cameras stand side by side, so that a row of the result shows one row of the depth camera.
  forEachRow(model.height, [&](std::uint32_t row) {
    const double own_row = std::round((row - to.cy) * from.fy / to.fy + from.cy);
    if (!(own_row >= 0.0 && own_row < own.height))
      return;
    for (std::uint32_t column = 0; column < own.width; ++column) {
      const std::size_t k = static_cast<std::size_t>(own_row) * own.width + column;
      if (own.depth[k] == 0)
        continue;
      const double shift = 1000.0 * to.fx * model.depth_camera.x / own.depth[k];
      // Both corners rounded and both columns included, as in librealsense: no gaps, and what is near grows.
      const double left = std::floor(scale * (column - 0.5 - from.cx) + shift + to.cx + 0.5);
      const double right = std::floor(scale * (column + 0.5 - from.cx) + shift + to.cx + 0.5);
      const double first = std::max(0.0, left);
      const double end = std::min(static_cast<double>(model.width), right + 1.0);
      for (auto u = first; u < end; u += 1.0) {
        const std::size_t i = std::size_t{row} * model.width + static_cast<std::size_t>(u);
        if (result.depth[i] == 0 || own.depth[k] < result.depth[i])
          result.copy(i, own, k);
      }
    }
  });
  return result;
}

}  // namespace grasp_affordances
