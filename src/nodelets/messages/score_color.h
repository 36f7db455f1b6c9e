#pragma once

#include <std_msgs/ColorRGBA.h>

#include <algorithm>

namespace grasp_affordances
{

/// Red for a score of 0 over yellow to green for 1; opaque. Scores outside are taken for the nearest of these.
inline std_msgs::ColorRGBA scoreColor(double score)
{
  const double bounded = score > 0.0 ? std::min(score, 1.0) : 0.0;  // 0 also where it is not a number
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(std::min(2.0 - 2.0 * bounded, 1.0));
  color.g = static_cast<float>(std::min(2.0 * bounded, 1.0));
  color.b = 0.0F;
  color.a = 1.0F;
  return color;
}

}  // namespace grasp_affordances
