#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localization.h"
#include "rendering/color.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// A part of a cloud, with a color per point.
struct ColoredCloud
{
  Cloud cloud;
  std::vector<Color> colors;
};

/// Green: affordances; yellow: doubtful; grey: not graspable; and magenta for the affordance `marked`, if any.
std::vector<Color> labelColors(const std::vector<std::uint32_t>& labels, std::uint32_t marked = 0);

/// What a sphere (m) projects to, seen by the cloud's sensor; the points in the sphere where the cloud has no range
/// image.
ColoredCloud closeUp(const Cloud& cloud, const std::vector<Color>& colors, const Eigen::Vector3d& center,
                     double radius);

/// The points around a shell over its length, seen along its axis with the sensor's side above, or any side where the
/// sensor's place is not known. Shell and points are
/// moved into the frame of a camera 2 m away.
ColoredCloud crossSection(const Cloud& cloud, const std::vector<Color>& colors, Shell& shell);

}  // namespace grasp_affordances
