#pragma once

#include "grasp_affordances/cloud.h"

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Noise about planes at some depth.
struct PlaneNoise
{
  double depth = 0.0;       ///< m, mean of the patches
  double deviation = 0.0;   ///< m, along the optical axis: the lower quartile of the patches' standard deviations
  std::size_t patches = 0;  ///< number of patches that show one smooth surface
};

/// What the runs of smooth surface along rows and columns do where they end. An edge is a step of depth by 5 cm or more
/// from one run to the next, with at most 60 pixels between them.
struct EdgeProfile
{
  std::size_t edges = 0;   ///< number of steps
  double ramp = 0.0;       ///< px, mean number of pixels between the runs that lie in the middle 80 % of the step
  double hole = 0.0;       ///< px, mean number of pixels between the runs without a measurement
  double with_hole = 0.0;  ///< share of the steps with such a pixel
  double shadow = 0.0;  ///< m, widths of the holes divided by the changes of f / z, both added up: about the distance
                        ///< from the camera to the projector or second camera whose shadow the holes are
};

/// What a depth image tells about its sensor. Rendered and recorded images of like scenes are compared by it.
struct SensorStatistics
{
  double holes = 0.0;          ///< share of the pixels without a measurement
  double surface_holes = 0.0;  ///< the same, of pixels whose row and column both show one surface around them
  EdgeProfile left;            ///< steps along rows on the left of the nearer surface: the shadow of a projector on +x
  EdgeProfile right;           ///< steps along rows on its right
  EdgeProfile vertical;        ///< steps along columns
  std::vector<PlaneNoise> noise;  ///< in ascending depth, one per 20 cm in which there are patches
};

/// @param cloud organized
SensorStatistics sensorStatistics(const Cloud& cloud);

}  // namespace grasp_affordances
