#pragma once

#include "grasp_affordances/cloud.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/throttle.h"

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/CameraInfo.h>

#include <mutex>
#include <optional>
#include <string>

namespace grasp_affordances
{

/// The latest camera_info that goes with a topic of clouds, where there is one.
class CameraInfoInput
{
public:
  void subscribe(ros::NodeHandle& node_handle, const std::string& topic);
  void unsubscribe();

  /// The projection of an organized cloud; nothing where no camera_info has come, or, with a complaint under the
  /// logger's name that names the topic, where it does not fit the cloud. From one thread, any.
  std::optional<PinholeIntrinsics> intrinsics(const Cloud& cloud, const std::string& logger);

private:
  ros::Subscriber subscriber_;
  std::mutex mutex_;  // guards the following two
  std::string topic_;
  sensor_msgs::CameraInfoConstPtr latest_;
  Throttle complaints_;
  CallbackGate gate_;
};

}  // namespace grasp_affordances
