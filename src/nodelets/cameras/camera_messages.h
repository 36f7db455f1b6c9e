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

/// A camera without distortion.
sensor_msgs::CameraInfoPtr cameraInfoMessage(const PinholeIntrinsics& camera, std::uint32_t width, std::uint32_t height,
                                             const std_msgs::Header& header);

/// What a simulated camera publishes for one frame.
struct FrameMessages
{
  sensor_msgs::CameraInfoPtr camera_info;
  sensor_msgs::ImagePtr depth;         ///< 16UC1, millimetres, 0 where nothing was measured (REP 118)
  sensor_msgs::PointCloud2Ptr points;  ///< organized, float x y z in metres, NaN where nothing was measured
};

FrameMessages frameMessages(const Frame& frame, const XtionModel& model, const std_msgs::Header& header);

/// Makes the messages ready to be published once more, at another time. Subscribers in this process share what was
/// published: a message that one of them still holds stays as it is, and a copy takes its place.
void restamp(FrameMessages& messages, const ros::Time& stamp);

}  // namespace grasp_affordances
