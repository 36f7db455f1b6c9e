#pragma once

#include "grasp_affordances/CylindricalShellArray.h"
#include "grasp_affordances/HandleArray.h"
#include "grasp_affordances/LocalizationStatistics.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"
#include "nodelets/localizer/handle_tracking.h"
#include "nodelets/messages/markers.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/throttle.h"
#include "nodelets/selection/handle_selection.h"

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
/// (LocalizationStatistics), the selection of a handle (see HandleSelection), whether anybody listens to them, and what
/// became of the clouds. A nodelet with several cameras counts what it localizes as one, a set of clouds, as a cloud.
class LocalizationOutputs
{
public:
  using Clock = std::chrono::steady_clock;

  /// What was published for a cloud.
  struct Messages
  {
    CylindricalShellArrayConstPtr shells;
    HandleArrayConstPtr handles;
    LocalizationStatisticsConstPtr statistics;
  };

  /// Advertises. `subscribe` is called when the inputs are needed: not `lazy`, at once; else while somebody listens to
  /// an output or, `on_demand`, only while there is demand(). `unsubscribe` is called when they no longer are, and when
  /// `subscribe` throws a ros::Exception, which is logged; then it is tried again with the next listener. Both come
  /// from any thread, one at a time.
  void advertise(ros::NodeHandle& private_node_handle, const std::string& name, bool lazy, bool on_demand,
                 std::function<void()> subscribe, std::function<void()> unsubscribe);

  /// Whether the inputs are needed, whoever listens. From any thread.
  /// @return why they cannot be had; empty where they can
  std::string demand(bool needed);

  /// Unsubscribes for good, and answers no more calls. The outputs remain: a result may still be on its way.
  void close();

  /// Counts a cloud that came in and hands it over; `hand_over` returns whether another one was dropped for it.
  /// From any thread.
  void receive(const std::function<bool()>& hand_over);

  /// Counts a cloud that came in and is left out, for the rate or because nobody asked for it. From any thread.
  void leaveOut();

  // The following come from one thread: the worker's.

  /// Counts a cloud that cannot be used, and says why.
  void reject(const std::string& reason);

  /// Counts a cloud that a transform is missing for, and says which.
  void leaveUntransformed(const std::string& reason);

  /// Counts and publishes a result, of its handles what is known of them after it. `config`: of this cloud, the
  /// outputs' own parameters among them. `arrival`: when its cloud came in. `header`: of all outputs.
  /// `workspace_frame`: that the box of `config` is in. `fixed_frame`: that handles are tracked in.
  Messages publish(const Localization& localization, const Config& config, const std_msgs::Header& header,
                   Clock::time_point arrival, const std::string& workspace_frame,
                   const FixedFrame& fixed_frame = FixedFrame());

private:
  bool anybodyListens() const;
  std::string updateSubscriptions();  // returns why the inputs cannot be had

  std::string name_;
  bool lazy_ = true;
  bool on_demand_ = false;
  std::function<void()> subscribe_;
  std::function<void()> unsubscribe_;

  std::mutex connections_mutex_;  // guards the publishers, open_, demanded_ and subscribed_
  bool open_ = false;             // a connection that is under way at the end must not subscribe again
  bool demanded_ = false;
  bool subscribed_ = false;
  Throttle missing_inputs_;
  ros::Publisher shells_;
  ros::Publisher handles_;
  ros::Publisher hand_poses_;
  ros::Publisher markers_;
  ros::Publisher statistics_;
  HandleSelection selection_;

  std::mutex counters_mutex_;  // guards the following, which are read and written together
  std::uint64_t received_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t left_out_ = 0;

  // Of the worker's thread.
  std::uint64_t processed_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t untransformed_ = 0;
  HandleTracking handle_tracking_;
  LocalizationMarkers localization_markers_;
  Throttle rejections_;
  Throttle missing_transforms_;
  Throttle warnings_;

  CallbackGate gate_;  // of connections
};

}  // namespace grasp_affordances
