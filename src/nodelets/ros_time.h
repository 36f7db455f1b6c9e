#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>
#include <ros/wall_timer.h>

#include <string>

namespace grasp_affordances
{

/// Notices when the stamps of a stream of messages go back, as where a bag is played again from its start or a
/// simulation is reset: whatever was learnt from later stamps is then of another run. Judged by the messages alone,
/// because a looping `rosbag play` sends the first of them before it sets the ROS clock back, and without --clock never
/// does. Of one thread.
class TimeJumps
{
public:
  /// Whether this stamp is earlier than the one before. A stamp of zero is none and says nothing.
  bool wentBack(const ros::Time& stamp);

private:
  ros::Time latest_;  // zero before the first
};

/// Where ROS time is simulated: complains once per period of wall-clock time, under the logger's name, until a /clock
/// arrives. To be kept while that is wanted.
ros::WallTimer complainWithoutClock(ros::NodeHandle& node_handle, const std::string& logger);

}  // namespace grasp_affordances
