#pragma once

#include "simulation/measured_image.h"

#include <cstdint>

namespace grasp_affordances
{

/// Fills holes along the rows that are at most so many pixels wide. Each pixel takes over what the farther one of the
/// pixels at the hole's ends shows.
void fillHoles(std::uint32_t widest, MeasuredImage& image);

/// Replaces each measured depth by the mean of those in a square that differ from it by at most a step.
/// @param radius px, of the square; 0: nothing is done
/// @param step mm
void smoothDepth(std::uint32_t radius, double step, MeasuredImage& image);

}  // namespace grasp_affordances
