#pragma once

#include "simulation/scene_library.h"

#include <vector>

namespace grasp_affordances
{

/// The ten scenes of the paper (figure 5), by name and, as far as it tells, by content.
std::vector<NamedScene> paperScenes();

}  // namespace grasp_affordances
