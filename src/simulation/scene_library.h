#pragma once

#include "simulation/background.h"
#include "simulation/camera_pose.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A scene with a name. Sizes, places and the camera's pose vary with the seed.
struct NamedScene
{
  std::string name;
  std::string family;       ///< scenes of one kind, whose results are pooled
  std::string description;  ///< one line
  View (*generate)(std::uint64_t seed);
};

const std::vector<NamedScene>& sceneLibrary();

/// Family of a scene. @throw std::invalid_argument for a name that is not in the library.
const std::string& sceneFamily(const std::string& name);

/// @throw std::invalid_argument for a name that is not in the library, and as posed() does; std::runtime_error for a
/// seed that leaves no room for an object.
View makeScene(const std::string& name, std::uint64_t seed, Background background = Background::walls,
               const CameraPose& camera = CameraPose());

}  // namespace grasp_affordances
