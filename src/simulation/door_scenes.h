#pragma once

#include "simulation/scene_library.h"

#include <vector>

namespace grasp_affordances
{

/// Handles on fronts: a cupboard with drawers, an oven beside a refrigerator, a room's door.
std::vector<NamedScene> doorScenes();

}  // namespace grasp_affordances
