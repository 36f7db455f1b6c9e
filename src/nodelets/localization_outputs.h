#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"
#include "nodelets/markers.h"
#include "nodelets/throttle.h"

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

namespace grasp_affordances
{

/// What localizing nodelets have in common: their outputs ~shells (CylindricalShellArray), ~handles (HandleArray),
/// ~hand_poses (geometry_msgs/PoseArray), ~markers (visualization_msgs/MarkerArray) and ~statistics
/// (LocalizationStatistics), whether anybody listens to them, and what became of the clouds. A nodelet with several
/// cameras counts what it localizes as one, a set of clouds, as a cloud.
class LocalizationOutputs
{
public:
  using Clock = std::chrono::steady_clock;

  /// Advertises. `subscribe` is called when the inputs are needed, which is while somebody listens to an output or, not
  /// `lazy`, at once; `unsubscribe` when they no longer are. Both come from any thread, one at a time and in turn.
  void advertise(ros::NodeHandle& private_node_handle, const std::string& name, bool lazy,
                 std::function<void()> subscribe, std::function<void()> unsubscribe);

  /// Unsubscribes for good. The outputs remain: a result may still be on its way.
  void close();

  /// Counts a cloud that came in and hands it over; `hand_over` returns whether another one was dropped for it.
  /// From any thread.
  void receive(const std::function<bool()>& hand_over);

  // The following come from one thread: the worker's.

  /// Counts a cloud that cannot be used, and says why.
  void reject(const std::string& reason);

  /// Counts a cloud that a transform is missing for, and says which.
  void leaveUntransformed(const std::string& reason);

  /// Counts and publishes a result. `arrival`: when its cloud came in. `header`: of all outputs. `workspace_frame`:
  /// that the box of `config` is in.
  void publish(const Localization& localization, const Config& config, const std_msgs::Header& header,
               Clock::time_point arrival, const std::string& workspace_frame);

private:
  bool anybodyListens() const;
  void updateSubscriptions();

  std::string name_;
  bool lazy_ = true;
  std::function<void()> subscribe_;
  std::function<void()> unsubscribe_;

  std::mutex connections_mutex_;  // guards the publishers, open_ and subscribed_
  bool open_ = false;             // a connection that is under way at the end must not subscribe again
  bool subscribed_ = false;
  ros::Publisher shells_;
  ros::Publisher handles_;
  ros::Publisher hand_poses_;
  ros::Publisher markers_;
  ros::Publisher statistics_;

  std::mutex counters_mutex_;  // guards received_ and dropped_, which are read and written together
  std::uint64_t received_ = 0;
  std::uint64_t dropped_ = 0;

  // Of the worker's thread.
  std::uint64_t processed_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t untransformed_ = 0;
  LocalizationMarkers localization_markers_;
  Throttle rejections_;
  Throttle missing_transforms_;
  Throttle warnings_;
};

}  // namespace grasp_affordances
