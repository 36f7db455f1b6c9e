#include "nodelets/localizer/localization_publishers.h"

#include "nodelets/messages/conversions.h"

#include <geometry_msgs/PoseArray.h>
#include <ros/init.h>
#include <visualization_msgs/MarkerArray.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <array>

namespace grasp_affordances
{

void LocalizationPublishers::advertise(const ros::NodeHandle& private_node_handle, const std::string& name,
                                       double max_age, const std::function<void()>& listeners_changed)
{
  const auto changed =
      gate_.guarded([listeners_changed](const ros::SingleSubscriberPublisher&) { listeners_changed(); });
  // Until onInit() has returned, nodelet 1.10 disables the queues of a nodelet, and roscpp drops what is called back
  // by them: of a listener that connects just then the nodelet would never hear.
  ros::NodeHandle outputs(private_node_handle);
  outputs.setCallbackQueue(ros::getGlobalCallbackQueue());
  shells_ = outputs.advertise<CylindricalShellArray>("shells", 1, changed, changed);
  handles_ = outputs.advertise<HandleArray>("handles", 1, changed, changed);
  hand_poses_ = outputs.advertise<geometry_msgs::PoseArray>("hand_poses", 1, changed, changed);
  markers_ = outputs.advertise<visualization_msgs::MarkerArray>("markers", 1, changed, changed);
  statistics_ = outputs.advertise<LocalizationStatistics>("statistics", 1, changed, changed);
  selection_.advertise(outputs, name, max_age, gate_.guarded(listeners_changed));
}

bool LocalizationPublishers::anybodyListens() const
{
  const auto heard = [](const ros::Publisher* publisher) { return publisher->getNumSubscribers() > 0; };
  const std::array<const ros::Publisher*, 5> all{&shells_, &handles_, &hand_poses_, &markers_, &statistics_};
  return std::any_of(all.begin(), all.end(), heard) || selection_.anybodyListens();
}

LocalizationPublishers::Messages LocalizationPublishers::publish(const Result& result, CloudCounters& counters)
{
  const std_msgs::Header& header = result.header;
  const std::vector<GraspHandle>& known = result.known_handles;
  const auto shells = boost::make_shared<CylindricalShellArray>(shellsMessage(result.localization, header));
  const auto handles = boost::make_shared<HandleArray>(handlesMessage(known, header));
  shells_.publish(shells);
  handles_.publish(handles);
  selection_.update(known, result.config, header, result.arrival);
  hand_poses_.publish(boost::make_shared<geometry_msgs::PoseArray>(handPosesMessage(known, header)));
  markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(
      localization_markers_.update(result.localization.shells, known, result.config, header, result.workspace_frame)));

  auto statistics =
      boost::make_shared<LocalizationStatistics>(statisticsMessage(result.localization, result.config, header));
  counters.report(*statistics);
  statistics->milliseconds_latency =
      std::chrono::duration<double, std::milli>(Clock::now() - result.arrival.steady).count();
  statistics_.publish(statistics);
  return {shells, handles, statistics};
}

void LocalizationPublishers::close()
{
  selection_.close();
  gate_.close();
}

}  // namespace grasp_affordances
