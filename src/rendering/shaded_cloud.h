#pragma once

#include "grasp_affordances/cloud.h"
#include "rendering/color.h"
#include "rendering/picture_camera.h"

#include <vector>

namespace grasp_affordances
{

/// What a camera sees of a cloud, row-major.
struct ShadedCloud
{
  std::vector<float> depth;   ///< m along the camera's z; NaN where there is nothing
  std::vector<Color> pixels;  ///< lit from the camera; the background where there is nothing
};

/// @param colors  of the points, desaturated for the shading; empty: grey
ShadedCloud shade(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera);

}  // namespace grasp_affordances
