#pragma once

#include "grasp_affordances/cloud.h"

#include <optional>

namespace grasp_affordances
{

/// The angles that a camera's picture spans, in radians.
struct FieldOfView
{
  double horizontal = 0.0;
  double vertical = 0.0;
};

/// Projection of a camera without distortion for pictures of that size, the principal point in their middle. Of a 5:4
/// picture, as an Xtion's of 1280x1024, the angles and the middle are those of the 4:3 picture without its last rows.
/// None where an angle is not between 0 and pi: some drivers and recordings know no better.
std::optional<PinholeIntrinsics> pinholeIntrinsics(const FieldOfView& field_of_view, int width, int height);

}  // namespace grasp_affordances
