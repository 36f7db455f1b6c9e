#pragma once

#include "grasp_affordances/point_cloud2.h"

#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <functional>
#include <string>

namespace grasp_affordances
{

/// What becomes of the clouds of a bag. `index` counts the topic's messages from 0, `count` is their number.
struct BagVisitor
{
  std::function<void(const sensor_msgs::PointCloud2& message, std::size_t index, std::size_t count)> cloud;
  std::function<void(const std::string& reason, std::size_t index, std::size_t count)> malformed;
};

/// Reads the sensor_msgs/PointCloud2 messages of a bag, one at a time, in the order of their recording. Needs no ROS
/// master. A malformed message is handed to `malformed`; those after it are still read.
/// @param topic  exactly as recorded; empty: the only PointCloud2 topic of the bag
/// @throw CloudError, without the path, for a file that is no readable and indexed bag, and for a topic that is not
/// there, is not of this type, is not given but needed, or has no messages.
void readBagClouds(const std::string& path, const std::string& topic, const BagVisitor& visitor);

}  // namespace grasp_affordances
