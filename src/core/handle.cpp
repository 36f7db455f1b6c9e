#include "grasp_affordances/handle.h"

#include "grasp_affordances/localization.h"

namespace grasp_affordances
{

void transform(const Eigen::Isometry3d& T, GraspHandle& handle)
{
  handle.centroid = T * handle.centroid;
  handle.axis = withLargestComponentPositive(T.linear() * handle.axis);
  handle.normal = T.linear() * handle.normal;
  for (Eigen::Vector3d& point : handle.polyline) {
    point = T * point;
  }
  for (GraspPose& hand : handle.hand_poses) {
    hand.pose = T * hand.pose;
  }
}

}  // namespace grasp_affordances
