#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include "core/prepared_views.h"

#include <Eigen/Geometry>

namespace grasp_affordances
{

/// Poses on rings around a handle's axis from which a hand reaches it.
class HandPoseSearch
{
public:
  /// Sets handle.hand_poses.
  /// @param T_approach_common  to the frame in which HandPosesConfig gives the direction of approach
  void search(const PreparedViews& views, const Config& config, const Eigen::Isometry3d& T_approach_common,
              GraspHandle& handle);
};

}  // namespace grasp_affordances
