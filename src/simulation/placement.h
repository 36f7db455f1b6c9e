#pragma once

#include <Eigen/Geometry>

namespace grasp_affordances
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

inline Eigen::Isometry3d at(double x, double y, double z)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

inline Eigen::Isometry3d turned(double angle, const Eigen::Vector3d& axis)
{
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, axis));
}

/// Upright at (x, y) on the plane z = 0, turned about the vertical.
inline Eigen::Isometry3d upright(double x, double y, double yaw)
{
  return at(x, y, 0.0) * turned(yaw, Eigen::Vector3d::UnitZ());
}

/// Frame with its origin halfway from `from` to `to` and its z axis in that direction.
inline Eigen::Isometry3d halfway(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from).toRotationMatrix();
  T.translation() = 0.5 * (from + to);
  return T;
}

/// Optical frame of a camera at `eye` that has `target` in the middle of its picture, with z up in the scene.
inline Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target)
{
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
  T_scene_camera.linear() << right, forward.cross(right), forward;
  T_scene_camera.translation() = eye;
  return T_scene_camera;
}

}  // namespace grasp_affordances
