#pragma once

#include "simulation/scene_library.h"

#include <vector>

namespace grasp_affordances
{

/// The families of tools, of groceries and of things on a desk.
std::vector<NamedScene> everydayScenes();

}  // namespace grasp_affordances
