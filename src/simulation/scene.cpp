#include "simulation/scene.h"

#include <algorithm>
#include <stdexcept>

namespace grasp_affordances
{

void Scene::beginObject(const std::string& name, Role role)
{
  objects_.push_back(name);
  roles_.push_back(role);
}

std::size_t Scene::add(const Primitive& shape, const Eigen::Isometry3d& T_scene_shape, Surface surface)
{
  validate(shape);
  if (objects_.empty()) {
    beginObject("object");
  }
  parts_.push_back({shape, T_scene_shape, surface, objects_.size() - 1});
  return parts_.size() - 1;
}

void Scene::join(const std::vector<std::size_t>& parts)
{
  for (const std::size_t part : parts) {
    const bool joined = std::any_of(chains_.begin(), chains_.end(), [&](const std::vector<std::size_t>& chain) {
      return std::find(chain.begin(), chain.end(), part) != chain.end();
    });
    if (part >= parts_.size() || joined || std::count(parts.begin(), parts.end(), part) != 1)
      throw std::invalid_argument("Scene::join: part " + std::to_string(part) + " is unknown or joined already");
  }
  chains_.push_back(parts);
}

}  // namespace grasp_affordances
