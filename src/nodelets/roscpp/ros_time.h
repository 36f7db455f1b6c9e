#pragma once

#include <ros/duration.h>
#include <ros/node_handle.h>
#include <ros/time.h>
#include <ros/wall_timer.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace grasp_affordances
{

/// Whether some seconds can be added to a stamp: roscpp throws beyond the end of its 32 bits, and takes nanoseconds of
/// up to four seconds from a message as they are.
inline bool leavesRoom(const ros::Time& stamp)
{
  constexpr std::uint32_t kRoom = 60;  // s
  return stamp.sec < ros::TIME_MAX.sec - kRoom;
}

/// s by which stamps may be out of order: several publishers, or several threads, may share a topic. What is older by
/// more is of another run.
constexpr double kDisorder = 0.5;

/// Whether a stamp is earlier than another one by more than a tolerance. A stamp of zero is none, and no other is
/// earlier than that.
bool isEarlier(const ros::Time& stamp, const ros::Time& than, ros::Duration tolerance);

/// Notices when the stamps of a stream of messages go back, as where a bag is played again from its start or a
/// simulation is reset: whatever was learnt from later stamps is then of another run. Judged by the messages alone,
/// because a looping `rosbag play` sends the first of them before it sets the ROS clock back, and without --clock never
/// does. Of one thread.
class TimeJumps
{
public:
  /// @param tolerance  by which stamps may be out of order, as those of several publishers on one topic are
  explicit TimeJumps(ros::Duration tolerance = ros::Duration()) : tolerance_(tolerance) {}

  /// Whether this stamp is earlier than the latest so far, by more than the tolerance; that one is then forgotten. A
  /// stamp of zero is none and says nothing.
  bool wentBack(const ros::Time& stamp);

private:
  ros::Duration tolerance_;
  ros::Time latest_;  // zero before the first
};

/// A moment by two clocks.
struct Moment
{
  std::chrono::steady_clock::time_point steady;  ///< never stands still or goes back
  ros::Time simulated;                           ///< zero where ROS time is not simulated, or no /clock has come

  static Moment now();
};

/// s from one moment to a later one: in simulated time, so that nothing ages while a simulation or a bag is paused.
/// Where that is not known, or went back, by the steady clock.
double secondsBetween(const Moment& from, const Moment& to);

/// Where ROS time is simulated: complains once per period of wall-clock time, under the logger's name, until a /clock
/// arrives. To be kept while that is wanted.
ros::WallTimer complainWithoutClock(ros::NodeHandle& node_handle, const std::string& logger);

}  // namespace grasp_affordances
