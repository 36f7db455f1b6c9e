#pragma once

#include <cstdint>

namespace grasp_affordances
{

/// Finds the pixels of an image row whose surface the camera sees but the projector, beside it on +x, does not.
///
/// A point in column u with disparity d is in the projector's column u - d. Everything between the point and the
/// projector is therefore in columns to the right of u. Neighbouring pixels show one surface if their disparities
/// differ by less than a pixel; with a larger difference the surface would be edge-on to the projector or turned away
/// from it. The result is exact for all occluders that the camera sees. It ignores occluders that are hidden from the
/// camera or outside its image.
///
/// @param disparity px, of the points to judge; 0 where there is none
/// @param occluder px, of the opaque surfaces; 0 where there is none
/// @param[out] shadowed 1 where the projector does not see the point, else 0
void findProjectorShadow(const float* disparity, const float* occluder, int width, std::uint8_t* shadowed);

}  // namespace grasp_affordances
