#include "nodelets/localizer/single_cloud.h"

#include "grasp_affordances/point_cloud2.h"
#include "nodelets/localizer/input_topic.h"
#include "nodelets/localizer/silence.h"

#include <ros/console.h>

#include <chrono>

namespace grasp_affordances
{

SingleCloud::SingleCloud(const ros::NodeHandle& node_handle, const std::string& name)
    : name_(name),
      points_topic_(inputTopic(node_handle, name, "points")),
      camera_info_topic_(inputTopic(node_handle, name, "camera_info")),
      node_handle_(node_handle)
{
}

std::string SingleCloud::awaited() const
{
  return "cloud on " + points_topic_;
}

void SingleCloud::subscribe(const Receiver& receiver)
{
  pace_.begin(std::chrono::steady_clock::now());
  camera_info_.subscribe(node_handle_, camera_info_topic_);
  points_ = node_handle_.subscribe<sensor_msgs::PointCloud2>(
      points_topic_, kCloudQueue, gate_.guarded([this, receiver](const sensor_msgs::PointCloud2ConstPtr& message) {
        pace_.arrive(std::chrono::steady_clock::now());
        if (time_jumps_.wentBack(message->header.stamp)) {
          receiver.time_is_back(message->header.stamp);
        }
        receiver.receive({message});
      }));
  silence_ = node_handle_.createWallTimer(ros::WallDuration(kSilence),
                                          gate_.guarded([this](const ros::WallTimerEvent&) { complainOfSilence(); }));
}

void SingleCloud::unsubscribe()
{
  silence_.stop();
  points_.shutdown();
  camera_info_.unsubscribe();
}

void SingleCloud::complainOfSilence()
{
  const CloudPace::Time now = std::chrono::steady_clock::now();
  if (pace_.isOverdue(now) && pace_.arrivals() != 1) {
    ROS_WARN_STREAM_NAMED(name_, "nothing is localized: no clouds arrive on " << describeSilence(points_, pace_, now));
  }
}

void SingleCloud::close()
{
  gate_.close();
}

CloudInput::Gathered SingleCloud::gather(const Clouds& messages)
{
  const sensor_msgs::PointCloud2& message = *messages.front();
  cloudFromPointCloud2(message, cloud_);
  cloud_.intrinsics = camera_info_.intrinsics(cloud_, name_);
  return {{&cloud_}, message.header};
}

}  // namespace grasp_affordances
