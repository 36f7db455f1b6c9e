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
  const NeighborhoodSearch* hidden = nullptr;                      ///< as in ShellSurroundings
  const RangeImage* image = nullptr;                               ///< as in ShellSurroundings
  Eigen::Isometry3d T_other_this = Eigen::Isometry3d::Identity();  ///< from the shell's frame to the other sensor's
};

/// What a shell is searched in.
struct ShellSurroundings
{
  const NeighborhoodSearch& cloud;             ///< the measured points
  const NeighborhoodSearch* hidden = nullptr;  ///< points of surfaces that are continued behind others: these block a
                                               ///< gap, too; null for none
  const RangeImage* image = nullptr;           ///< null for a cloud that is no range image
  double spacing = 0.0;                        ///< m, between neighboring points; 0: unknown
  const std::vector<OtherView>* others = nullptr;  ///< other views of the scene, whose points count, too; null for none
};

}  // namespace grasp_affordances
