#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace grasp_affordances
{

/// Axis-aligned rectangle in a picture, in pixels.
using Rectangle = Eigen::AlignedBox2d;

/// Chooses the place of a label of a given size: the one of eight places around `subject` where it covers least of
/// `taken` and reaches least out of `picture`. Among equal places the first counts; the very first is to the right.
Rectangle labelPlace(const Rectangle& picture, const Rectangle& subject, const Eigen::Vector2d& size,
                     const std::vector<Rectangle>& taken);

}  // namespace grasp_affordances
