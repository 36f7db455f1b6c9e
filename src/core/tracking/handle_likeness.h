#pragma once

#include "core/tracking/axis_curve.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

namespace grasp_affordances
{

/// The properties of a handle that tell it from other handles.
struct HandleShape
{
  explicit HandleShape(const GraspHandle& handle);

  AxisCurve curve;
  Eigen::Vector3d centroid;
  double radius;
  double inner_radius;
};

/// Whether a handle is not much longer than it is thick, such as an apple or the end of a banana. The axis of such a
/// handle may have any direction.
bool isBlob(const HandleShape& shape);

/// How unlikely it is that two shapes are the same handle in successive clouds: 0 for equal shapes, 1 or more for
/// different handles, infinity beyond the limits of TrackingConfig.
///
/// The axes are compared where they are nearest, without regard to their signs. Blobs (see isBlob) may also be compared
/// by their centroids alone. The result is symmetric, except for two bent handles of the same length.
double unlikeness(const HandleShape& a, const HandleShape& b, const TrackingConfig& config);

/// Whether a part is found where the whole handle is known to be. The part's axis must run along the whole's axis, at a
/// mean distance of at most the whole's inner radius: no other handle has its axis there. A good part of it must be
/// between the whole's ends.
bool isPiece(const HandleShape& part, const HandleShape& whole, const TrackingConfig& config);

}  // namespace grasp_affordances
