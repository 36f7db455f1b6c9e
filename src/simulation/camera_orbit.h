#pragma once

#include "simulation/scene.h"

#include <Eigen/Geometry>

namespace grasp_affordances
{

/// Moves the camera of a view on a small circle. The camera always looks at the same point, where the view's optical
/// axis meets the scene, from the same distance. Its line of sight moves on a cone about the view's line of sight, at
/// constant speed. Safe to use from several threads.
class CameraOrbit
{
public:
  /// @param amplitude half the cone's opening angle, rad; 0: the camera stands still
  /// @param period of one turn, s; above 0
  CameraOrbit(const View& view, double amplitude, double period);

  /// T_scene_camera (optical frame) at a time in seconds since any epoch.
  Eigen::Isometry3d pose(double time) const;

private:
  Eigen::Isometry3d T_scene_camera_;
  Eigen::Translation3d T_camera_target_;
  double amplitude_;
  double period_;
};

/// The same scene seen by a camera that is turned about a vertical axis (the scene's z) through the point that it looks
/// at. Height, tilt and distance from that point stay the same.
/// @param angle rad, counter-clockwise as seen from above; with 0 the pose is exactly the same
View viewFromAside(View view, double angle);

}  // namespace grasp_affordances
