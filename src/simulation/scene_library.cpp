#include "simulation/scene_library.h"

#include "simulation/basic_scenes.h"
#include "simulation/door_scenes.h"
#include "simulation/everyday_scenes.h"
#include "simulation/hard_scenes.h"
#include "simulation/paper_scenes.h"

#include <algorithm>
#include <stdexcept>

namespace grasp_affordances
{

namespace
{

const NamedScene& namedScene(const std::string& name)
{
  const auto& library = sceneLibrary();
  const auto found =
      std::find_if(library.begin(), library.end(), [&](const NamedScene& scene) { return scene.name == name; });
  if (found == library.end())
    throw std::invalid_argument("unknown scene '" + name + "'");
  return *found;
}

}  // namespace

const std::vector<NamedScene>& sceneLibrary()
{
  static const std::vector<NamedScene> library = [] {
    std::vector<NamedScene> scenes = basicScenes();
    for (const std::vector<NamedScene>& more : {paperScenes(), hardScenes(), doorScenes(), everydayScenes()})
      scenes.insert(scenes.end(), more.begin(), more.end());
    return scenes;
  }();
  return library;
}

const std::string& sceneFamily(const std::string& name)
{
  return namedScene(name).family;
}

View makeScene(const std::string& name, std::uint64_t seed, Background background, const CameraPose& camera)
{
  return withBackground(posed(namedScene(name).generate(seed), camera), background, seed);
}

}  // namespace grasp_affordances
