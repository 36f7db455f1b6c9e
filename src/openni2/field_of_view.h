#pragma once

#include "grasp_affordances/cloud.h"

#include <optional>

namespace grasp_affordances
{

/// Opening angles of a camera, in radians.
struct FieldOfView
{
  double horizontal = 0.0;
  double vertical = 0.0;
};

/// Intrinsics of a camera without distortion, for images of a size in pixels. The principal point is the image's
/// middle. The last rows of a 5:4 image, as an Xtion's of 1280x1024, do not count: field of view and middle are those
/// of the 4:3 image above them. Returns nothing if an angle is not between 0 and pi, as some drivers and recordings
/// report.
std::optional<PinholeIntrinsics> pinholeIntrinsics(const FieldOfView& field_of_view, int width, int height);

}  // namespace grasp_affordances
