#pragma once

#include <Eigen/Geometry>

// Not inline: Eigen's rotation between two vectors takes long to compile.
namespace grasp_affordances
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

Eigen::Isometry3d at(double x, double y, double z);

/// @param axis unit vector
Eigen::Isometry3d turned(double angle, const Eigen::Vector3d& axis);

/// Pose of an upright object at (x, y) on the plane z = 0, turned about the vertical.
Eigen::Isometry3d upright(double x, double y, double yaw);

/// Frame at the origin whose z axis has the direction of `z`, by the shortest rotation.
Eigen::Isometry3d frameAlong(const Eigen::Vector3d& z);

/// Frame with its origin halfway from `from` to `to` and its z axis in that direction.
Eigen::Isometry3d halfway(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Optical frame of a camera at `eye` with `target` in the middle of its picture. The scene's z is up.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

}  // namespace grasp_affordances
