#pragma once

#include "grasp_affordances/RegionOfInterest.h"
#include "nodelets/localizer/cloud_counters.h"
#include "nodelets/localizer/cloud_input.h"
#include "nodelets/localizer/framed_localizer.h"
#include "nodelets/localizer/handle_tracking.h"
#include "nodelets/localizer/input_demand.h"
#include "nodelets/localizer/localization_publishers.h"
#include "nodelets/localizer/localize_service.h"
#include "nodelets/localizer/trigger_service.h"
#include "nodelets/parameters/parameters_ros.h"
#include "nodelets/parameters/reconfiguration.h"
#include "nodelets/roscpp/name_claim.h"
#include "nodelets/roscpp/newest_only_worker.h"
#include "nodelets/roscpp/rate_limiter.h"
#include "nodelets/roscpp/ros_time.h"
#include "nodelets/roscpp/throttle.h"
#include "nodelets/roscpp/transforms.h"

#include <ros/node_handle.h>
#include <ros/time.h>
#include <ros/wall_timer.h>
#include <std_msgs/Header.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What every localizing nodelet does, whatever its input: it waits for the clouds of a moment, localizes in the newest
/// in a thread of its own, tracks handles and publishes. It owns the node's name, parameters, transforms, services,
/// outputs and worker, and ends them in order.
///
/// Published: see LocalizationPublishers. Services: ~trigger (TriggerService), ~select and ~best (HandleSelection),
/// dynamic_reconfigure (Reconfiguration) and, where it is asked for, ~localize (LocalizeService), which has a localizer
/// of its own: it neither waits for the clouds that arrive nor holds them up.
class LocalizingLoop
{
public:
  /// What a node is started with.
  struct Setup
  {
    NodeParameters parameters;
    std::unique_ptr<CloudInput> input;
    bool always_listens_to_tf = false;  ///< false: only where a parameter names a frame, or with `on_demand`
    bool offers_localize = false;       ///< the service ~localize
  };

  LocalizingLoop() = default;
  LocalizingLoop(const LocalizingLoop&) = delete;
  LocalizingLoop& operator=(const LocalizingLoop&) = delete;
  ~LocalizingLoop();

  /// Starts the node. To be called once.
  /// @param name    full name of the node
  /// @param set_up  reads the parameters and makes the input; called when no other node of this name is left in the
  /// process
  /// @throw what `set_up` throws, such as ParameterError, and std::runtime_error; it has then been logged
  void start(ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle, const std::string& name,
             const std::function<Setup()>& set_up);

private:
  struct Arrival
  {
    CloudInput::Clouds clouds;
    Moment time;
  };

  void receive(const CloudInput::Clouds& clouds);
  void startAgain(const ros::Time& stamp);
  void process(const Arrival& arrival);
  void localize(const Arrival& arrival, const std::optional<RegionOfInterest>& call);
  void warnOfSlashes(const std::vector<std_msgs::Header>& clouds);
  void warnOfFrames(const std_msgs::Header& output);
  std::unique_ptr<FramedLocalizer> makeLocalizer(const Config& config);

  NameClaim name_claim_;  // first: it is the last to go
  std::string name_;
  Setup setup_;
  CloudCounters counters_;
  LocalizationPublishers publishers_;
  InputDemand demand_;
  ros::WallTimer clock_complaint_;
  std::unique_ptr<Transforms> transforms_;

  // Of the callback for clouds.
  Throttle reported_jumps_;
  std::optional<RateLimiter> rate_limiter_;

  std::atomic<bool> ending_{false};

  // Of the worker's thread.
  std::unique_ptr<FramedLocalizer> localizer_;
  HandleTracking handle_tracking_;
  Throttle rejections_;
  Throttle missing_transforms_;
  Throttle warnings_;
  bool warned_of_slashes_ = false;
  bool warned_of_frames_ = false;

  TriggerService trigger_;
  LocalizeService localize_service_;
  Reconfiguration reconfiguration_;

  std::unique_ptr<NewestOnlyWorker<Arrival>> worker_;
};

}  // namespace grasp_affordances
