#pragma once

#include <cstdint>

namespace grasp_affordances
{

/// Finds what one row of a structured-light camera sees but its projector, beside it on +x, does not.
///
/// A point in column u with disparity d is in the projector's column u - d, so that everything between it and the
/// projector is in columns to its right. Neighbouring pixels show one surface where their disparities differ by less
/// than a pixel: at a larger difference a surface would be edge-on to the projector or turned away from it. Exact for
/// all occluders that the camera sees; unaware of those that are hidden from it or outside its picture.
///
/// @param disparity px, of the points to judge; 0 where there is none
/// @param occluder px, of the surfaces that light does not pass; 0 where there is none
/// @param[out] shadowed 1 where the projector does not see the point, else 0
void findProjectorShadow(const float* disparity, const float* occluder, int width, std::uint8_t* shadowed);

}  // namespace grasp_affordances
