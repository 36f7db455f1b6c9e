#pragma once

#include "simulation/scene_library.h"

#include <vector>

namespace grasp_affordances
{

/// Families beyond the paper: far away, in clutter, and with nothing to grasp.
std::vector<NamedScene> hardScenes();

}  // namespace grasp_affordances
