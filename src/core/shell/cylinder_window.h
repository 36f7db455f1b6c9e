#pragma once

#include "core/cloud/range_image.h"
#include "core/kernels/axis_points.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grasp_affordances
{

/// A piece of a cylinder about the line through `origin` along `axis` (unit), from `begin` to `end` along the line.
/// Metres.
struct CylinderPiece
{
  Eigen::Vector3d origin, axis;
  double radius, begin, end;

  Eigen::Vector3d middle() const { return origin + (begin + end) / 2 * axis; }

  /// Distance (m) from the middle to the piece's farthest point in a direction (unit).
  double reach(const Eigen::Vector3d& direction) const
  {
    const double along = axis.dot(direction);
    return radius * std::sqrt(std::max(0.0, 1.0 - along * along)) + (end - begin) / 2 * std::abs(along);
  }
};

/// The pixels of the image onto which the piece projects, row by row. They contain every measured point within it.
void cylinderSpans(const RangeImage& image, const CylinderPiece& piece, std::vector<PixelSpan>& spans);

/// The largest error (m) that single precision makes in chooseInCylinder about the place of a point in the piece.
double roundingWithin(const CylinderPiece& piece);

/// Bounds of a piece for chooseInCylinder, widened so that rounding loses no point.
/// @param rounding  m, see roundingWithin
CylinderBounds looseBounds(const CylinderPiece& piece, double rounding);

}  // namespace grasp_affordances
