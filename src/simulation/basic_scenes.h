#pragma once

#include "simulation/scene_library.h"

#include <vector>

namespace grasp_affordances
{

/// Small scenes for tests and examples.
std::vector<NamedScene> basicScenes();

}  // namespace grasp_affordances
