#include "nodelets/localizer/silence.h"

#include <ros/master.h>
#include <ros/message_traits.h>
#include <ros/this_node.h>
#include <sensor_msgs/PointCloud2.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>

namespace grasp_affordances
{
namespace
{

/// Topics of clouds that somebody publishes, joined by commas.
std::string topicsOfClouds()
{
  XmlRpc::XmlRpcValue request, response, topics;
  request[0] = ros::this_node::getName();
  request[1] = "";
  const bool wait_for_master = false;
  std::string joined;
  if (!ros::master::execute("getPublishedTopics", request, response, topics, wait_for_master)) {
    return joined;
  }
  const std::string type = ros::message_traits::datatype<sensor_msgs::PointCloud2>();
  for (int i = 0; i < topics.size(); ++i) {
    if (std::string(topics[i][1]) == type) {
      joined += (joined.empty() ? "" : ", ") + std::string(topics[i][0]);
    }
  }
  return joined;
}

}  // namespace

std::string describeSilence(const ros::Subscriber& points)
{
  const std::uint32_t publishers = points.getNumPublishers();
  if (publishers == 1) {
    return points.getTopic() + " (its publisher sends nothing)";
  }
  if (publishers > 1) {
    return points.getTopic() + " (its " + std::to_string(publishers) + " publishers send nothing)";
  }
  const std::string topics = topicsOfClouds();
  return points.getTopic() + " (nobody publishes there; " +
         (topics.empty() ? "no topic has clouds" : "topics with clouds: " + topics) + ")";
}

}  // namespace grasp_affordances
