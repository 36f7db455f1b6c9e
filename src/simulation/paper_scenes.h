#pragma once

#include "simulation/scene_library.h"

#include <vector>

namespace grasp_affordances
{

/// The ten scenes of the paper (figure 5). Their names are the paper's; so are their contents, as far as it gives them.
std::vector<NamedScene> paperScenes();

}  // namespace grasp_affordances
