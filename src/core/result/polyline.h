#pragma once

#include "grasp_affordances/handle.h"

#include <Eigen/Core>

#include <cstddef>

namespace grasp_affordances
{

/// The place of a polyline that is nearest to a point.
struct PolylinePlace
{
  std::size_t segment = 0;                           ///< index of the point that its segment starts at
  double share = 0.0;                                ///< of the segment, from its start, in [0, 1]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the place to the point
  bool is_beyond_end = false;  ///< the place is an end, and the point beyond the plane at right angles to it
};

PolylinePlace nearestPlace(const Polyline& polyline, const Eigen::Vector3d& point);

/// Unit, towards the polyline's end. Turns evenly along each segment, so that along a polyline with equal segments on a
/// circle it is the circle's tangent, but for the first and the last one.
Eigen::Vector3d tangentAt(const Polyline& polyline, const PolylinePlace& place);

/// Distance of the point at right angles to the polyline, also of one beyond an end.
double distanceAcross(const Polyline& polyline, const PolylinePlace& place);

}  // namespace grasp_affordances
