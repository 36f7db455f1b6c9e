#include "simulation/ray_caster.h"

#include <algorithm>

namespace grasp_affordances
{

RayCaster::RayCaster(const Scene& scene, const Eigen::Isometry3d& T_scene_camera)
{
  for (const Part& part : scene.parts()) {
    const Eigen::Isometry3d T_shape_camera = part.T_scene_shape.inverse() * T_scene_camera;
    targets_.push_back({&part, T_shape_camera.inverse().translation(), boundingRadius(part.shape),
                        T_shape_camera.linear(), T_shape_camera.translation()});
  }
}

std::optional<Hit> RayCaster::cast(const Eigen::Vector3d& direction) const
{
  const double length = direction.norm();
  const Eigen::Vector3d unit = direction / length;

  Hit nearest{kNoIntersection, nullptr};
  for (const Target& target : targets_) {
    const double along = target.centre_camera.dot(unit);
    const double squared_half_chord =
        target.bounding_radius * target.bounding_radius - (target.centre_camera - along * unit).squaredNorm();
    if (squared_half_chord <= 0.0 || along + target.bounding_radius <= 0.0 ||
        along - target.bounding_radius > nearest.t * length)
      continue;
    const double t = intersect(target.part->shape, {target.camera_shape, target.R_shape_camera * direction});
    if (t < nearest.t)
      nearest = {t, target.part};
  }
  if (nearest.part == nullptr)
    return std::nullopt;
  return nearest;
}

}  // namespace grasp_affordances
