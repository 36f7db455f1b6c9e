#pragma once

#include "grasp_affordances/cloud.h"
#include "nodelets/localizer/camera_info_input.h"
#include "nodelets/localizer/cloud_input.h"
#include "nodelets/localizer/cloud_pace.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/ros_time.h"

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include <string>

namespace grasp_affordances
{

/// The clouds of one camera. Subscribed, in the parent namespace of the node's name: points (sensor_msgs/PointCloud2)
/// and camera_info (sensor_msgs/CameraInfo, optional). The common frame is that of the cloud. Warns where no cloud
/// arrives, or no more, by the pace so far; a single cloud may be all that somebody publishes.
class SingleCloud : public CloudInput
{
public:
  /// @param name  full name of the node
  SingleCloud(const ros::NodeHandle& node_handle, const std::string& name);

  std::string awaited() const override;
  void subscribe(const Receiver& receiver) override;
  void unsubscribe() override;
  void close() override;
  Gathered gather(const Clouds& messages) override;

private:
  void complainOfSilence();

  std::string name_, points_topic_, camera_info_topic_;
  ros::NodeHandle node_handle_;
  ros::Subscriber points_;
  CameraInfoInput camera_info_;
  ros::WallTimer silence_;

  // Of the callback for clouds and of the timer, which take turns.
  TimeJumps time_jumps_{ros::Duration(kDisorder)};
  CloudPace pace_;

  Cloud cloud_;        // of the worker's thread
  CallbackGate gate_;  // of clouds
};

}  // namespace grasp_affordances
