#pragma once

#include "nodelets/localizer/cloud_pace.h"

#include <ros/subscriber.h>

#include <string>

namespace grasp_affordances
{

/// s of wall-clock time between looks at whether clouds are overdue, and so between warnings.
constexpr double kSilence = 5.0;

/// Why clouds may be overdue on a subscribed topic, in words that follow "no clouds arrive on ": the topic's resolved
/// name; how long ago the last one came; the nodes that are registered as its publishers, those that cannot be reached
/// apart; the topic's type where that is another one; where nobody publishes clouds there, topics on which clouds are
/// published. Asks the master, and does not wait for one that is gone. Takes up to half a second for each publisher
/// that cannot be reached.
std::string describeSilence(const ros::Subscriber& points, const CloudPace& pace, CloudPace::Time now);

}  // namespace grasp_affordances
