#include "simulation/camera_pose.h"

#include "simulation/placement.h"
#include "simulation/things.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace grasp_affordances
{

View posed(View view, const CameraPose& pose)
{
  if (!pose.tilt && !pose.distance)
    return view;
  constexpr double kNearest = 0.1;  // m, of the point looked at
  const Eigen::Vector3d eye = view.T_scene_camera.translation();
  const Eigen::Vector3d forward = view.T_scene_camera.linear().col(2);
  const double level = forward.head<2>().norm();
  if (level < 1e-6)
    throw std::invalid_argument("the camera of this scene looks along the vertical: it has no tilt or distance to set");
  const double so_far = std::max(kNearest, forward.dot(middleOfThings(view.scene) - eye));
  const Eigen::Vector3d target = eye + so_far * forward;
  const double tilt = pose.tilt.value_or(std::asin(std::clamp(-forward.z(), -1.0, 1.0)));
  const double distance = pose.distance.value_or(so_far);
  const Eigen::Vector2d ahead = std::cos(tilt) / level * forward.head<2>();
  view.T_scene_camera = lookAt(target - distance * Eigen::Vector3d(ahead.x(), ahead.y(), -std::sin(tilt)), target);
  return view;
}

}  // namespace grasp_affordances
