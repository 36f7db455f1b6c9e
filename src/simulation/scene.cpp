#include "simulation/scene.h"

namespace grasp_affordances
{

void Scene::add(const Primitive& shape, const Eigen::Isometry3d& T_scene_shape, std::uint32_t label, Surface surface)
{
  validate(shape);
  parts_.push_back({shape, T_scene_shape, label, surface});
}

}  // namespace grasp_affordances
