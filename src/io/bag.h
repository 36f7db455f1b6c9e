#pragma once

#include "grasp_affordances/point_cloud2.h"

#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <functional>
#include <string>

namespace grasp_affordances
{

/// Callbacks for the clouds of a bag. `index` is the message's number within the topic, from 0; `count` is the number
/// of messages.
struct BagVisitor
{
  std::function<void(const sensor_msgs::PointCloud2& message, std::size_t index, std::size_t count)> cloud;
  std::function<void(const std::string& reason, std::size_t index, std::size_t count)> malformed;
};

/// Whether a file begins as bags do. False also for what cannot be read.
bool isBag(const std::string& path);

/// Reads the sensor_msgs/PointCloud2 messages of a bag, one at a time, in the order of recording. Needs no ROS master.
/// A malformed message is passed to `malformed`, and reading goes on with the next one. A chunk of the bag is unpacked
/// when its first message is read, so what comes before a damaged chunk has been visited when it is found.
/// @param topic  exactly as recorded, which need not be a valid name of ROS; empty: the only topic of the bag with such
/// messages
/// @throw CloudError, without the path in its text, if the file is not a readable bag with an index, or if it is
/// damaged; if the topic is missing, has another type or no messages; or if no topic is given and the bag has several.
void readBagClouds(const std::string& path, const std::string& topic, const BagVisitor& visitor);

}  // namespace grasp_affordances
