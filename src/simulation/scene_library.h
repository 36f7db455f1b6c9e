#pragma once

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
  std::string description;  ///< one line
  View (*generate)(std::uint64_t seed);
};

const std::vector<NamedScene>& sceneLibrary();

/// @throw std::invalid_argument for a name that is not in the library.
View makeScene(const std::string& name, std::uint64_t seed);

}  // namespace grasp_affordances
