#pragma once

#include "grasp_affordances/handle.h"

#include <Eigen/Core>

#include <cstddef>

namespace grasp_affordances
{

// All that walks along a polyline but AxisCurve (core/tracking/axis_curve.h), which goes on straight beyond the ends.
// Its length is lengthOf(), in the installed grasp_affordances/handle.h.

/// A place at a distance along a polyline.
struct PolylineDistance
{
  std::size_t segment = 0;      ///< index of the point that the segment starts at
  double from_start = 0.0;      ///< m, from the start of the segment
  double segment_length = 0.0;  ///< m
};

/// The place at a distance (m, at least 0) from the beginning. Segments of length zero are passed over. Beyond the end
/// of the polyline it is in the last segment, with `from_start` greater than the segment's length.
PolylineDistance placeAtDistance(const Polyline& polyline, double distance);

/// The point at a distance (m) from the beginning along the polyline. A distance below zero gives the first point, one
/// beyond the length the last point.
Eigen::Vector3d pointAt(const Polyline& polyline, double distance);

/// The point in the middle of the length, and the direction (unit) of the polyline there; z where the length is zero.
struct PolylineMiddle
{
  Eigen::Vector3d point, direction;
};
PolylineMiddle middleOf(const Polyline& polyline);

/// From the point before one of a polyline's points to the point after it; at an end, from or to the end itself.
Eigen::Vector3d chordAround(const Polyline& polyline, std::size_t i);

/// The place of a polyline that is nearest to a point.
struct PolylinePlace
{
  std::size_t segment = 0;                           ///< index of the point that its segment starts at
  double share = 0.0;                                ///< of the segment, from its start, in [0, 1]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m, from the place to the point
  bool is_beyond_end = false;  ///< the place is an end, and the point beyond the plane at right angles to it
};

PolylinePlace nearestPlace(const Polyline& polyline, const Eigen::Vector3d& point);

/// Unit, towards the polyline's end. Turns evenly along each segment. So along a polyline with equal segments on a
/// circle it is the circle's tangent, except on the first and the last segment.
Eigen::Vector3d tangentAt(const Polyline& polyline, const PolylinePlace& place);

/// Distance (m) of the point at right angles to the polyline. Beyond an end it is the distance from the prolonged
/// segment.
double distanceAcross(const Polyline& polyline, const PolylinePlace& place);

/// Distance (m) of a point from those segments beside which it lies. The first segment does not count for points before
/// its start, the last one not for points beyond its end; infinity where no segment counts. nearestPlace() differs: its
/// place is an end where that is nearest, even if the point lies beside another segment.
double distanceBeside(const Polyline& polyline, const Eigen::Vector3d& point);

}  // namespace grasp_affordances
