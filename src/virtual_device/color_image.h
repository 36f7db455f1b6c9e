#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What a camera at the view's pose sees of its scene, row-major, red, green, blue: each object in a color of its own,
/// lit from the camera, black where there is nothing. Materials and textures are not simulated.
std::vector<std::uint8_t> colorImage(const View& view, const PinholeIntrinsics& camera, std::uint32_t width,
                                     std::uint32_t height);

}  // namespace grasp_affordances
