#pragma once

#include "grasp_affordances/cloud.h"
#include "nodelets/localizer/camera_info_input.h"
#include "nodelets/localizer/cloud_input.h"
#include "nodelets/localizer/cloud_pace.h"
#include "nodelets/parameters/parameters_ros.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/cloud_clock.h"
#include "nodelets/roscpp/cloud_synchronizer.h"
#include "nodelets/roscpp/ros_time.h"
#include "nodelets/roscpp/throttle.h"

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <ros/wall_timer.h>

#include <cstddef>
#include <deque>
#include <string>

namespace grasp_affordances
{

/// The clouds of several cameras whose stamps differ by little: a set, one cloud of each camera. Subscribed, in the
/// parent namespace of the node's name: points_1, points_2, ... (sensor_msgs/PointCloud2) and camera_info_1, ...
/// (sensor_msgs/CameraInfo, optional). The common frame is the target frame. Warns where no set comes about. Where the
/// stamps of a camera do not advance, all clouds are put together by the times of their arrival (see CloudClock).
class SynchronizedClouds : public CloudInput
{
public:
  /// @param name  full name of the node
  SynchronizedClouds(const ros::NodeHandle& node_handle, const std::string& name,
                     const MultiCameraParameters& parameters);

  std::string awaited() const override { return "set of clouds"; }
  void subscribe(const Receiver& receiver) override;
  void unsubscribe() override;
  void close() override;
  Gathered gather(const Clouds& messages) override;

private:
  struct View
  {
    std::string points_topic, camera_info_topic;
    ros::Subscriber points;
    CameraInfoInput camera_info;

    // Of the callbacks for clouds and of the timer, which take turns.
    TimeJumps time_jumps{ros::Duration(kDisorder)};
    CloudClock clock;
    CloudPace pace;
    ros::Time newest;  // stamp

    Cloud cloud;  // of the worker's thread
  };

  void receive(std::size_t view, const sensor_msgs::PointCloud2ConstPtr& message);
  void startAgain(const ros::Time& stamp);
  void forgetTimes();
  ros::Time timeOf(std::size_t view, const ros::Time& stamp);
  void complainOfSilence();
  std::string silentCameras(CloudPace::Time now) const;
  void complainOfSharedFrames(const Clouds& messages);

  const std::string name_;
  const std::string target_frame_;
  const double sync_slop_;  // s
  ros::NodeHandle node_handle_;
  std::deque<View> views_;
  ros::WallTimer silence_;

  // Of the callbacks for clouds and of the timer.
  Receiver receiver_;
  CloudSynchronizer synchronizer_;
  CloudPace::Time latest_set_;  // or when it subscribed
  bool by_arrival_ = false;     // are the clouds put together

  Throttle shared_frames_;  // of the worker's thread

  CallbackGate gate_;  // of clouds
};

}  // namespace grasp_affordances
