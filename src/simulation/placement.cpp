#include "simulation/placement.h"

namespace grasp_affordances
{

Eigen::Isometry3d at(double x, double y, double z)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

Eigen::Isometry3d turned(double angle, const Eigen::Vector3d& axis)
{
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, axis));
}

Eigen::Isometry3d upright(double x, double y, double yaw)
{
  return at(x, y, 0.0) * turned(yaw, Eigen::Vector3d::UnitZ());
}

Eigen::Isometry3d frameAlong(const Eigen::Vector3d& z)
{
  return Eigen::Isometry3d(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), z));
}

Eigen::Isometry3d halfway(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  Eigen::Isometry3d T = frameAlong(to - from);
  T.translation() = 0.5 * (from + to);
  return T;
}

Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target)
{
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
  T_scene_camera.linear() << right, forward.cross(right), forward;
  T_scene_camera.translation() = eye;
  return T_scene_camera;
}

}  // namespace grasp_affordances
