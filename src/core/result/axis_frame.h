#pragma once

#include "core/kernels/axis_points.h"

#include <Eigen/Geometry>

#include <limits>
#include <optional>

namespace grasp_affordances
{

// The frames that an axis has, and the directions at right angles to it.
//
// Two frames are made elsewhere, because their vectors are others. The camera of a close-up (evaluation/close_up.cpp)
// looks along the axis, with the normal upwards. The planes around a piece of a cylinder (shell/cylinder_window.cpp) go
// through the sensor. A frame whose normal is known needs one vector more: axis.cross(normal) is written out there.

/// Two directions at right angles to an axis and to each other: `first`, `second` and the axis are right-handed.
struct AcrossAxis
{
  Eigen::Vector3d first, second;  ///< unit
};

/// Any two such directions, the same ones for the same axis.
/// @param axis  unit
inline AcrossAxis acrossAxis(const Eigen::Vector3d& axis)
{
  const Eigen::Vector3d first = axis.unitOrthogonal();
  return {first, axis.cross(first)};
}

/// The direction (unit) at right angles to an axis that is nearest to a vector. Empty where the vector is along the
/// axis: where its part across the axis is not longer than `least`.
/// @param axis  unit
inline std::optional<Eigen::Vector3d> directionAcross(const Eigen::Vector3d& axis, const Eigen::Vector3d& vector,
                                                      double least)
{
  const Eigen::Vector3d part = vector - vector.dot(axis) * axis;
  return part.norm() > least ? std::make_optional<Eigen::Vector3d>(part.normalized()) : std::nullopt;
}

/// The same, but any direction at right angles to the axis where the vector is along it.
inline Eigen::Vector3d normalAcross(const Eigen::Vector3d& axis, const Eigen::Vector3d& vector, double least)
{
  return directionAcross(axis, vector, least).value_or(axis.unitOrthogonal());
}

/// The normal of shells and handles whose sensor's place is not known: NaN.
inline Eigen::Vector3d unknownNormal()
{
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

inline bool isKnown(const Eigen::Vector3d& normal)
{
  return normal.allFinite();
}

/// The normal, or any direction at right angles to the axis where the normal is not known.
/// @param axis  unit
inline Eigen::Vector3d normalOrAny(const Eigen::Vector3d& axis, const Eigen::Vector3d& normal)
{
  return isKnown(normal) ? normal : Eigen::Vector3d(axis.unitOrthogonal());
}

/// The rotation of a frame with its z along an axis: its columns are x, z cross x, and z.
/// @param z  unit
/// @param x  unit, at right angles to z
inline Eigen::Matrix3d rotationAlong(const Eigen::Vector3d& z, const Eigen::Vector3d& x)
{
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return rotation;
}

inline Eigen::Map<const Eigen::Vector3d> asVector(const double (&coordinates)[3])
{
  return Eigen::Map<const Eigen::Vector3d>(coordinates);
}

/// The frame as the kernels take it.
/// @param axis, across  orthonormal
inline AxisFrame axisFrame(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const AcrossAxis& across)
{
  AxisFrame frame;
  Eigen::Map<Eigen::Vector3d>(frame.origin) = origin;
  Eigen::Map<Eigen::Vector3d>(frame.axis) = axis;
  Eigen::Map<Eigen::Vector3d>(frame.first) = across.first;
  Eigen::Map<Eigen::Vector3d>(frame.second) = across.second;
  return frame;
}

/// The frame, given in one frame of reference, in the one that T leads to.
inline AxisFrame transformed(const AxisFrame& frame, const Eigen::Isometry3d& T)
{
  return axisFrame(T * asVector(frame.origin), T.linear() * asVector(frame.axis),
                   {T.linear() * asVector(frame.first), T.linear() * asVector(frame.second)});
}

}  // namespace grasp_affordances
