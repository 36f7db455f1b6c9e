#pragma once

#include "core/cloud/range_image.h"
#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Geometry>

#include <vector>

namespace grasp_affordances
{

/// The same scene at the same moment, as another sensor saw it.
struct OtherView
{
  const NeighborhoodSearch* cloud = nullptr;
  const NeighborhoodSearch* hidden = nullptr;                      ///< may be null, as in ShellSurroundings
  const RangeImage* image = nullptr;                               ///< may be null
  Eigen::Isometry3d T_other_this = Eigen::Isometry3d::Identity();  ///< to its frame, from that of the shell
};

/// What a shell is searched in.
struct ShellSurroundings
{
  const NeighborhoodSearch& cloud;
  const NeighborhoodSearch* hidden =
      nullptr;                        ///< what is taken to be where the sensor did not see: blocks gaps as well
  const RangeImage* image = nullptr;  ///< tells what was not seen, and how exactly depth was measured
  double spacing = 0.0;               ///< m, between neighboring points; 0: unknown
  const std::vector<OtherView>* others = nullptr;  ///< whose points count as well; null for none
};

}  // namespace grasp_affordances
