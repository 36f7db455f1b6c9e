#pragma once

#include <ros/subscriber.h>

#include <string>

namespace grasp_affordances
{

/// s of wall-clock time without clouds before a node warns, and between its warnings.
constexpr double kSilence = 5.0;

/// Why no clouds may arrive on a subscribed topic, in words that follow "no clouds arrive on ": the topic's resolved
/// name; how many publishers it has; where it has none, topics on which clouds are published. Asks the master, and does
/// not wait for one that is gone.
std::string describeSilence(const ros::Subscriber& points);

}  // namespace grasp_affordances
