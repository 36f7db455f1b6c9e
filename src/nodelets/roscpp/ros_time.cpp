#include "nodelets/roscpp/ros_time.h"

#include <ros/console.h>

#include <algorithm>
#include <cstdint>

namespace grasp_affordances
{
namespace
{

constexpr double kPeriod = 5.0;  // s

}  // namespace

bool TimeJumps::wentBack(const ros::Time& stamp)
{
  if (stamp.isZero()) {
    return false;
  }
  const bool back =
      stamp < latest_ && latest_.toNSec() - stamp.toNSec() > static_cast<std::uint64_t>(tolerance_.toNSec());
  latest_ = back ? stamp : std::max(latest_, stamp);
  return back;
}

ros::WallTimer complainWithoutClock(ros::NodeHandle& node_handle, const std::string& logger)
{
  if (!ros::Time::isSimTime()) {
    return {};
  }
  return node_handle.createWallTimer(ros::WallDuration(kPeriod), [logger](const ros::WallTimerEvent&) {
    if (ros::Time::now().isZero()) {
      ROS_WARN_STREAM_NAMED(logger,
                            "the parameter /use_sim_time is set, but nothing arrives on /clock: ROS time stands "
                            "still (rosbag play needs --clock)");
    }
  });
}

}  // namespace grasp_affordances
