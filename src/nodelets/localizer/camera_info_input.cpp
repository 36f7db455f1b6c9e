#include "nodelets/localizer/camera_info_input.h"

#include "nodelets/messages/conversions.h"

#include <ros/console.h>

#include <stdexcept>

namespace grasp_affordances
{

void CameraInfoInput::subscribe(ros::NodeHandle& node_handle, const std::string& topic)
{
  subscriber_ = node_handle.subscribe<sensor_msgs::CameraInfo>(
      topic, 1, gate_.guarded([this](const sensor_msgs::CameraInfoConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex_);
        latest_ = message;
      }));
  const std::lock_guard<std::mutex> lock(mutex_);
  topic_ = subscriber_.getTopic();
}

void CameraInfoInput::unsubscribe()
{
  subscriber_.shutdown();
}

std::optional<PinholeIntrinsics> CameraInfoInput::intrinsics(const Cloud& cloud, const std::string& logger)
{
  sensor_msgs::CameraInfoConstPtr camera;
  std::string topic;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    camera = latest_;
    topic = topic_;
  }
  if (!camera || !cloud.organized()) {
    return std::nullopt;
  }
  try {
    return intrinsicsFromCameraInfo(*camera, cloud.width, cloud.height);
  } catch (const std::invalid_argument& error) {
    if (complaints_.due()) {
      ROS_WARN_STREAM_NAMED(logger, "the camera_info on " << topic << " is ignored: " << error.what());
    }
    return std::nullopt;
  }
}

}  // namespace grasp_affordances
