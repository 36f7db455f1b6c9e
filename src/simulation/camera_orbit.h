#pragma once

#include "simulation/scene.h"

#include <Eigen/Geometry>

namespace grasp_affordances
{

/// Moves the camera of a view on a small circle: it keeps the point that it looks at, where its optical axis meets the
/// scene, in the middle of its picture and at the same distance, and its line of sight describes a cone about that of
/// the view at constant speed. Safe to use from several threads.
class CameraOrbit
{
public:
  /// @param amplitude half the cone's opening angle, rad; 0: the camera stands still
  /// @param period of one turn, s; above 0
  CameraOrbit(const View& view, double amplitude, double period);

  /// T_scene_camera (optical frame) at a time in seconds, of any epoch.
  Eigen::Isometry3d pose(double time) const;

private:
  Eigen::Isometry3d T_scene_camera_;
  Eigen::Translation3d T_camera_target_;
  double amplitude_;
  double period_;
};

/// The same scene by a camera turned about the scene's vertical, z, through the point that it looks at: it keeps its
/// height, its tilt and its distance from that point.
/// @param angle rad, counter-clockwise as seen from above; 0 leaves the pose as it is, to the last bit
View viewFromAside(View view, double angle);

}  // namespace grasp_affordances
