#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/sensor.h"

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <cstdint>

namespace grasp_affordances
{

/// CameraInfo of a camera without distortion. @param width,height of the image, pixels.
sensor_msgs::CameraInfoPtr cameraInfoMessage(const PinholeIntrinsics& camera, std::uint32_t width, std::uint32_t height,
                                             const std_msgs::Header& header);

/// The messages that a simulated camera publishes for one frame.
struct FrameMessages
{
  sensor_msgs::CameraInfoPtr camera_info;
  sensor_msgs::ImagePtr depth;         ///< 16UC1, millimetres, 0 where nothing was measured (REP 118)
  sensor_msgs::PointCloud2Ptr points;  ///< organized, float x y z in metres, NaN where nothing was measured
};

FrameMessages frameMessages(const Frame& frame, const SensorModel& model, const std_msgs::Header& header);

/// Gives the messages a new stamp, so that they can be published again. Subscribers in this process share published
/// messages. If one of them still holds a message, that message is not changed: a copy with the new stamp replaces it
/// in `messages`.
void restamp(FrameMessages& messages, const ros::Time& stamp);

}  // namespace grasp_affordances
