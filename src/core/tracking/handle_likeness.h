#pragma once

#include "core/tracking/axis_curve.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

namespace grasp_affordances
{

/// Of a handle, what tells it from others.
struct HandleShape
{
  explicit HandleShape(const GraspHandle& handle);

  AxisCurve curve;
  Eigen::Vector3d centroid;
  double radius;
  double inner_radius;
};

/// Whether a handle is not much longer than thick, an apple or the end of a banana: its axis may then have any
/// direction.
bool isBlob(const HandleShape& shape);

/// How unlikely two are the same handle in successive clouds, from 0; what costs 1 or more is another one. Symmetric,
/// but for bent ones of one length. Axes are compared where they are nearest, without regard to their sign; blobs also
/// by their centroids alone. Infinity beyond the limits of TrackingConfig.
double unlikeness(const HandleShape& a, const HandleShape& b, const TrackingConfig& config);

/// Whether the part is found where the whole is known to be: its axis runs along the other one, for a good part between
/// its ends and not farther from it than its shell, within which no other handle has its axis.
bool isPiece(const HandleShape& part, const HandleShape& whole, const TrackingConfig& config);

}  // namespace grasp_affordances
