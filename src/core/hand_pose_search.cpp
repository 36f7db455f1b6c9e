#include "core/hand_pose_search.h"

namespace grasp_affordances
{

void HandPoseSearch::search(const PreparedViews& /*views*/, const Config& config,
                            const Eigen::Isometry3d& /*T_approach_common*/, GraspHandle& handle)
{
  handle.hand_poses.clear();
  if (config.hand_poses.count == 0) {
    return;
  }
  GraspPose hand;
  hand.pose.linear() << -handle.normal, handle.axis.cross(-handle.normal), handle.axis;
  hand.pose.translation() = handle.centroid;
  hand.width = 2.0 * handle.inner_radius;
  hand.score = 1.0;
  handle.hand_poses.push_back(hand);
}

}  // namespace grasp_affordances
