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

bool isEarlier(const ros::Time& stamp, const ros::Time& than, ros::Duration tolerance)
{
  return stamp < than && than.toNSec() - stamp.toNSec() > static_cast<std::uint64_t>(tolerance.toNSec());
}

bool TimeJumps::wentBack(const ros::Time& stamp)
{
  if (stamp.isZero()) {
    return false;
  }
  const bool back = isEarlier(stamp, latest_, tolerance_);
  latest_ = back ? stamp : std::max(latest_, stamp);
  return back;
}

Moment Moment::now()
{
  return {std::chrono::steady_clock::now(), ros::Time::isSimTime() ? ros::Time::now() : ros::Time()};
}

double secondsBetween(const Moment& from, const Moment& to)
{
  if (!from.simulated.isZero() && from.simulated <= to.simulated) {
    return to.simulated.toSec() - from.simulated.toSec();
  }
  return std::chrono::duration<double>(to.steady - from.steady).count();
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
