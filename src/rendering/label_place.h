#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace grasp_affordances
{

/// Upright rectangle in a picture, in pixels.
using Rectangle = Eigen::AlignedBox2d;

/// Where a label of this size goes: beside `subject`, at one of eight places around it, where it covers least of
/// `taken` and reaches least out of `picture`. Of equally good ones the first, which is to the right.
Rectangle labelPlace(const Rectangle& picture, const Rectangle& subject, const Eigen::Vector2d& size,
                     const std::vector<Rectangle>& taken);

}  // namespace grasp_affordances
