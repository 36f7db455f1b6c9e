#pragma once

#include "grasp_affordances/point_cloud2.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace grasp_affordances
{

/// A color; its components are in [0, 1].
struct Color
{
  float r = 0.0F, g = 0.0F, b = 0.0F;
};

/// Reads the colors of a sensor_msgs::PointCloud2 or pcl::PCLPointCloud2 from its field `rgb` or `rgba` (0xRRGGBB in
/// the lower bytes), in the order of the points. Empty if there is no such field. The message's sizes must be
/// consistent; cloudFromPointCloud2 checks that.
template <class PointCloud2>
std::vector<Color> pointColors(const PointCloud2& message)
{
  std::vector<Color> colors;
  for (const auto& field : message.fields) {
    const bool is_color = field.name == "rgb" || field.name == "rgba";
    if (!is_color || std::uint64_t{field.offset} + 4 > message.point_step) {
      continue;
    }
    const std::uint64_t step = rowStep(message, message.data.size());
    colors.reserve(std::size_t{message.width} * message.height);
    for (std::size_t row = 0; row < message.height; ++row) {
      const std::uint8_t* point = message.data.data() + row * step + field.offset;
      for (std::size_t column = 0; column < message.width; ++column, point += message.point_step) {
        std::uint32_t rgb = 0;
        std::memcpy(&rgb, point, sizeof(rgb));
        const auto component = [rgb](int shift) { return static_cast<float>((rgb >> shift) & 0xFFU) / 255.0F; };
        colors.push_back({component(16), component(8), component(0)});
      }
    }
    break;
  }
  return colors;
}

}  // namespace grasp_affordances
