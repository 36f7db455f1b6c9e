#pragma once

#include "grasp_affordances/cloud.h"
#include "rendering/color.h"
#include "rendering/picture_camera.h"

#include <vector>

namespace grasp_affordances
{

/// Image of a cloud as a camera sees it, row-major.
struct ShadedCloud
{
  std::vector<float> depth;   ///< m along the camera's z; NaN if no point is there
  std::vector<Color> pixels;  ///< lit from the camera; the background color if no point is there
};

/// Renders a cloud. @param colors  of the points; they are desaturated for the shading; empty: grey
ShadedCloud shade(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera);

}  // namespace grasp_affordances
