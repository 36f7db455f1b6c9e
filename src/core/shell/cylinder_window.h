#pragma once

#include "core/cloud/range_image.h"
#include "core/kernels/axis_points.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grasp_affordances
{

/// A piece of a cylinder about the line through `origin` along `axis` (unit): [begin, end] along it. Metres.
struct CylinderPiece
{
  Eigen::Vector3d origin, axis;
  double radius, begin, end;

  Eigen::Vector3d middle() const { return origin + (begin + end) / 2 * axis; }

  /// How far it reaches from its middle in a direction (unit).
  double reach(const Eigen::Vector3d& direction) const
  {
    const double along = axis.dot(direction);
    return radius * std::sqrt(std::max(0.0, 1.0 - along * along)) + (end - begin) / 2 * std::abs(along);
  }
};

/// Pixels, row by row, that contain every measured point within the piece.
void cylinderSpans(const RangeImage& image, const CylinderPiece& piece, std::vector<PixelSpan>& spans);

/// By how much chooseInCylinder, in single precision, may be wrong about the place of a point in a piece (m).
double roundingWithin(const CylinderPiece& piece);

/// Bounds of a piece for chooseInCylinder, so loose that rounding loses no point.
CylinderBounds looseBounds(const CylinderPiece& piece, double rounding);

}  // namespace grasp_affordances
