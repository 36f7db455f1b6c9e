#include "simulation/things.h"

#include "simulation/arrangement.h"

namespace grasp_affordances
{

bool isThing(Role role)
{
  return role == Role::thing || role == Role::front;
}

Eigen::AlignedBox3d boundsOf(const Scene& scene, std::size_t object, const Eigen::Isometry3d& T_frame_scene)
{
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : pointsInside(scene, object))
    bounds.extend(T_frame_scene * point);
  return bounds;
}

Eigen::AlignedBox3d boundsOfThings(const Scene& scene, const Eigen::Isometry3d& T_frame_scene)
{
  Eigen::AlignedBox3d bounds;
  for (std::size_t object = 0; object < scene.objects().size(); ++object) {
    if (isThing(scene.roles()[object]))
      bounds.extend(boundsOf(scene, object, T_frame_scene));
  }
  return bounds;
}

Eigen::Vector3d middleOfThings(const Scene& scene)
{
  const Eigen::AlignedBox3d bounds = boundsOfThings(scene, Eigen::Isometry3d::Identity());
  return bounds.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(bounds.center());
}

}  // namespace grasp_affordances
