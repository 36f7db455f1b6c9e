#pragma once

#include "grasp_affordances/CylindricalShellArray.h"
#include "grasp_affordances/HandleArray.h"
#include "grasp_affordances/LocalizationStatistics.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"
#include "nodelets/localizer/cloud_counters.h"
#include "nodelets/messages/markers.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/ros_time.h"
#include "nodelets/selection/handle_selection.h"

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The outputs of a localizing node: ~shells (CylindricalShellArray), ~handles (HandleArray), ~hand_poses
/// (geometry_msgs/PoseArray), ~markers (visualization_msgs/MarkerArray), ~statistics (LocalizationStatistics) and the
/// selection of a handle (see HandleSelection).
class LocalizationPublishers
{
public:
  using Clock = std::chrono::steady_clock;

  /// A result, and what is published with it.
  struct Result
  {
    const Localization& localization;
    const std::vector<GraspHandle>& known_handles;  ///< after this cloud, tracked or not
    const Config& config;                           ///< of this cloud
    const std_msgs::Header& header;                 ///< of all outputs
    std::string workspace_frame;                    ///< of the box in `config`
    Moment arrival;                                 ///< of the cloud
  };

  /// What was published for a cloud.
  struct Messages
  {
    CylindricalShellArrayConstPtr shells;
    HandleArrayConstPtr handles;
    LocalizationStatisticsConstPtr statistics;
  };

  /// @param max_age  see HandleSelection::advertise()
  /// @param listeners_changed  called, from any thread, when somebody begins or ceases to listen; also before
  /// advertise() has returned
  void advertise(const ros::NodeHandle& private_node_handle, const std::string& name, double max_age,
                 const std::function<void()>& listeners_changed);

  /// Whether anybody listens to an output. From any thread, after advertise().
  bool anybodyListens() const;

  /// Publishes a result. From one thread.
  Messages publish(const Result& result, CloudCounters& counters);

  /// Answers no more calls, and tells of no more listeners. The topics remain: a result may still be on its way.
  void close();

private:
  ros::Publisher shells_;
  ros::Publisher handles_;
  ros::Publisher hand_poses_;
  ros::Publisher markers_;
  ros::Publisher statistics_;
  HandleSelection selection_;
  LocalizationMarkers localization_markers_;  // of the worker's thread

  CallbackGate gate_;  // of connections
};

}  // namespace grasp_affordances
