#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Renders the color image of a camera at the view's pose: row-major, bytes red, green, blue. Each object has its own
/// color and is lit from the camera; the background is black. Materials and textures are not simulated.
std::vector<std::uint8_t> colorImage(const View& view, const PinholeIntrinsics& camera, std::uint32_t width,
                                     std::uint32_t height);

}  // namespace grasp_affordances
