#include "simulation/camera_orbit.h"

#include "simulation/placement.h"
#include "simulation/ray_caster.h"

#include <cmath>
#include <optional>

namespace grasp_affordances
{
namespace
{

constexpr double kDistanceIntoTheVoid = 1.0;  // m, distance of the point looked at if the optical axis meets no surface

double distanceLookedAt(const View& view)
{
  const std::optional<Hit> hit = RayCaster(view.scene, view.T_scene_camera).cast(Eigen::Vector3d::UnitZ());
  return hit ? hit->t : kDistanceIntoTheVoid;
}

}  // namespace

CameraOrbit::CameraOrbit(const View& view, double amplitude, double period)
    : T_scene_camera_(view.T_scene_camera),
      T_camera_target_(0.0, 0.0, distanceLookedAt(view)),
      amplitude_(amplitude),
      period_(period)
{
}

Eigen::Isometry3d CameraOrbit::pose(double time) const
{
  const double phase = 2.0 * kPi * std::fmod(time, period_) / period_;
  const Eigen::Vector3d axis(std::cos(phase), std::sin(phase), 0.0);
  return T_scene_camera_ * T_camera_target_ * Eigen::AngleAxisd(amplitude_, axis) * T_camera_target_.inverse();
}

View viewFromAside(View view, double angle)
{
  if (angle == 0.0) {
    return view;
  }
  const Eigen::Translation3d T_scene_target(view.T_scene_camera * (distanceLookedAt(view) * Eigen::Vector3d::UnitZ()));
  view.T_scene_camera =
      T_scene_target * turned(angle, Eigen::Vector3d::UnitZ()) * T_scene_target.inverse() * view.T_scene_camera;
  return view;
}

}  // namespace grasp_affordances
