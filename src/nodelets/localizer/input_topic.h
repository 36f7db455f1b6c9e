#pragma once

#include <ros/names.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <string>

namespace grasp_affordances
{

/// Queue of a subscriber for clouds. Clouds that arrive in one burst are told apart, and counted, by the callback and
/// not by the queue.
constexpr std::uint32_t kCloudQueue = 5;

/// Absolute name of an input in the parent namespace of a node, remapped. Absolute, because a nodelet's own node handle
/// takes the root namespace for that of its manager.
inline std::string inputTopic(const ros::NodeHandle& node_handle, const std::string& node, const std::string& topic)
{
  return node_handle.resolveName(ros::names::append(ros::names::parentNamespace(node), topic));
}

}  // namespace grasp_affordances
