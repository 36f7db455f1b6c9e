#pragma once

#include "grasp_affordances/handle.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// A handle's axis, straight or bent. A place on it is given by s, the distance (m) along the axis from its first end.
/// Which end is the first is arbitrary.
///
/// Beyond its ends the curve goes on straight, so that an axis that is found longer has places there, too. This is why
/// it does not use core/result/polyline.h, where the places end with the polyline.
class AxisCurve
{
public:
  /// The place of the curve that is nearest to a point.
  struct Foot
  {
    double s = 0.0;         ///< m, below 0 or above length() for a point beyond an end
    double distance = 0.0;  ///< m, from the point to the curve between its ends
  };

  /// The curve of a handle's polyline. Where that has no length: a straight curve through the centroid along the axis.
  explicit AxisCurve(const GraspHandle& handle);

  /// @param points  from end to end, at least two, no two successive ones equal
  explicit AxisCurve(Polyline points);

  const Polyline& points() const { return points_; }
  double length() const { return ways_.back(); }
  bool straight() const { return points_.size() == 2; }

  Eigen::Vector3d at(double s) const;
  Eigen::Vector3d direction(double s) const;  ///< unit, towards larger s
  Foot foot(const Eigen::Vector3d& point) const;

  /// `count` points, at least two, at even distances from one place to another.
  Polyline spread(double from, double to, std::size_t count) const;

private:
  std::size_t pieceAt(double s) const;
  void measure();

  Polyline points_;
  std::vector<double> ways_;  // m, along the curve from the first point to each point
};

/// The straight curve fitted to at least two points by least squares. It leads from the first point, projected onto it,
/// to the last.
AxisCurve straightCurve(const Polyline& points);

}  // namespace grasp_affordances
