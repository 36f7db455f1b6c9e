#include "nodelets/localizer/silence.h"

#include "nodelets/roscpp/reachable.h"

#include <ros/master.h>
#include <ros/message_traits.h>
#include <ros/this_node.h>
#include <sensor_msgs/PointCloud2.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

namespace grasp_affordances
{
namespace
{

using Names = std::vector<std::string>;

/// What the master answers, a list; nothing where it does not.
std::optional<XmlRpc::XmlRpcValue> ask(const std::string& method, const std::optional<std::string>& argument = {})
{
  XmlRpc::XmlRpcValue request, response, answer;
  request[0] = ros::this_node::getName();
  if (argument) {
    request[1] = *argument;
  }
  const bool wait_for_master = false;
  if (!ros::master::execute(method, request, response, answer, wait_for_master)) {
    return std::nullopt;
  }
  return answer;
}

/// Nodes that are registered as publishers of a topic. `published`: all topics with theirs.
Names publishersOf(const std::string& topic, XmlRpc::XmlRpcValue& published)
{
  Names nodes;
  for (int i = 0; i < published.size(); ++i) {
    if (std::string(published[i][0]) == topic) {
      for (int j = 0; j < published[i][1].size(); ++j) {
        nodes.push_back(published[i][1][j]);
      }
    }
  }
  return nodes;
}

bool isReachable(const std::string& node)
{
  std::optional<XmlRpc::XmlRpcValue> uri = ask("lookupNode", node);
  return uri && isReachableAt(*uri);
}

std::string commaSeparated(const Names& names)
{
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

/// Of nodes that publish clouds, as they say. `connections`: how many of them roscpp has connected to; some of these
/// may have died since.
std::string describePublishers(const Names& nodes, std::uint32_t connections)
{
  Names mute, lost;
  std::partition_copy(nodes.begin(), nodes.end(), std::back_inserter(mute), std::back_inserter(lost),
                      [&](const std::string& node) { return connections > 0 && isReachable(node); });
  std::string text;
  if (!mute.empty()) {
    text = mute.size() == 1 ? "its publisher " + mute[0] + " sends nothing"
                            : "its publishers " + commaSeparated(mute) + " send nothing";
  }
  if (!lost.empty()) {
    text += (text.empty() ? "" : "; ") + std::string("registered but not connected: ") + commaSeparated(lost) +
            (lost.size() == 1 ? "; is it alive" : "; are they alive") + ", is ROS_IP/ROS_HOSTNAME right?";
  }
  return text;
}

std::string describeTopic(const std::string& topic, std::uint32_t connections)
{
  std::optional<XmlRpc::XmlRpcValue> graph = ask("getSystemState");
  std::optional<XmlRpc::XmlRpcValue> types = ask("getPublishedTopics", "");
  if (!graph || !types) {
    return "the master does not answer";
  }
  const std::string needed = ros::message_traits::datatype<sensor_msgs::PointCloud2>();
  std::string type;
  Names clouds;
  for (int i = 0; i < types->size(); ++i) {
    const std::string name = (*types)[i][0];
    if (name == topic) {
      type = std::string((*types)[i][1]);
    }
    if (std::string((*types)[i][1]) == needed) {
      clouds.push_back(name);
    }
  }
  const Names nodes = publishersOf(topic, (*graph)[0]);
  if (!nodes.empty() && type == needed) {
    return describePublishers(nodes, connections);
  }
  return (nodes.empty()
              ? "nobody publishes there"
              : "its type is " + type + ", published by " + commaSeparated(nodes) + ", but " + needed + " is needed") +
         (clouds.empty() ? "; no topic has clouds" : "; topics with clouds: " + commaSeparated(clouds));
}

}  // namespace

std::string describeSilence(const ros::Subscriber& points, const CloudPace& pace, CloudPace::Time now)
{
  const std::string waited = std::to_string(std::lround(pace.waited(now))) + " s";
  return points.getTopic() +
         (pace.arrivals() == 0 ? ", none came in " + waited : ", the last one came " + waited + " ago") + " (" +
         describeTopic(points.getTopic(), points.getNumPublishers()) + ")";
}

}  // namespace grasp_affordances
