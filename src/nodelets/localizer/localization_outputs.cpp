#include "nodelets/localizer/localization_outputs.h"

#include "nodelets/messages/conversions.h"
#include "nodelets/roscpp/subscribing.h"

#include <geometry_msgs/PoseArray.h>
#include <ros/console.h>
#include <ros/exception.h>
#include <visualization_msgs/MarkerArray.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines) {
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

}  // namespace

void LocalizationOutputs::advertise(ros::NodeHandle& private_node_handle, const std::string& name, bool lazy,
                                    bool on_demand, std::function<void()> subscribe, std::function<void()> unsubscribe)
{
  const auto changed = gate_.guarded([this](const ros::SingleSubscriberPublisher&) { updateSubscriptions(); });
  {
    // Somebody may connect to a publisher, in another thread, before advertise() has returned it or before the next
    // one exists: the callback has to wait for all of them.
    const std::lock_guard<std::mutex> lock(connections_mutex_);
    name_ = name;
    lazy_ = lazy;
    on_demand_ = on_demand;
    subscribe_ = std::move(subscribe);
    unsubscribe_ = std::move(unsubscribe);
    shells_ = private_node_handle.advertise<CylindricalShellArray>("shells", 1, changed, changed);
    handles_ = private_node_handle.advertise<HandleArray>("handles", 1, changed, changed);
    hand_poses_ = private_node_handle.advertise<geometry_msgs::PoseArray>("hand_poses", 1, changed, changed);
    markers_ = private_node_handle.advertise<visualization_msgs::MarkerArray>("markers", 1, changed, changed);
    statistics_ = private_node_handle.advertise<LocalizationStatistics>("statistics", 1, changed, changed);
    selection_.advertise(private_node_handle, name_, gate_.guarded([this] { updateSubscriptions(); }));
    open_ = true;
  }
  updateSubscriptions();
}

void LocalizationOutputs::close()
{
  selection_.close();
  gate_.close();
  {
    const std::lock_guard<std::mutex> lock(connections_mutex_);
    open_ = false;
  }
  updateSubscriptions();
}

std::string LocalizationOutputs::demand(bool needed)
{
  {
    const std::lock_guard<std::mutex> lock(connections_mutex_);
    demanded_ = needed;
  }
  return updateSubscriptions();
}

bool LocalizationOutputs::anybodyListens() const
{
  const auto heard = [](const ros::Publisher* publisher) { return publisher->getNumSubscribers() > 0; };
  const std::array<const ros::Publisher*, 5> all{&shells_, &handles_, &hand_poses_, &markers_, &statistics_};
  return std::any_of(all.begin(), all.end(), heard) || selection_.anybodyListens();
}

std::string LocalizationOutputs::updateSubscriptions()
{
  const std::lock_guard<std::mutex> lock(connections_mutex_);
  const bool needed = open_ && (!lazy_ || demanded_ || (!on_demand_ && anybodyListens()));
  if (needed == subscribed_) {
    return "";
  }
  const std::lock_guard<std::mutex> alone(subscribing());
  if (!needed) {
    subscribed_ = false;
    unsubscribe_();
    return "";
  }
  try {
    subscribe_();
    subscribed_ = true;
    return "";
  } catch (const ros::Exception& error) {  // in a callback of the manager's, which would end with all its nodelets
    unsubscribe_();
    if (missing_inputs_.due()) {
      ROS_ERROR_STREAM_NAMED(name_, "nothing is localized, for want of input: " << error.what());
    }
    return error.what();
  }
}

void LocalizationOutputs::receive(const std::function<bool()>& hand_over)
{
  const std::lock_guard<std::mutex> lock(counters_mutex_);
  ++received_;
  dropped_ += hand_over() ? 1 : 0;
}

void LocalizationOutputs::leaveOut()
{
  const std::lock_guard<std::mutex> lock(counters_mutex_);
  ++received_;
  ++left_out_;
}

void LocalizationOutputs::reject(const std::string& reason)
{
  ++rejected_;
  if (rejections_.due()) {
    ROS_ERROR_STREAM_NAMED(name_, "cloud rejected: " << reason);
  }
}

void LocalizationOutputs::leaveUntransformed(const std::string& reason)
{
  ++untransformed_;
  if (missing_transforms_.due()) {
    ROS_WARN_STREAM_NAMED(name_, "cloud dropped for want of a transform: " << reason);
  }
}

LocalizationOutputs::Messages LocalizationOutputs::publish(const Localization& localization, const Config& config,
                                                           const std_msgs::Header& header, Clock::time_point arrival,
                                                           const std::string& workspace_frame,
                                                           const FixedFrame& fixed_frame)
{
  ++processed_;
  if (!localization.warnings.empty() && warnings_.due()) {
    ROS_WARN_STREAM_NAMED(name_, joined(localization.warnings));
  }
  const std::vector<GraspHandle>& known =
      handle_tracking_.update(localization.handles, config.tracking, header, fixed_frame);
  const auto shells = boost::make_shared<CylindricalShellArray>(shellsMessage(localization, header));
  const auto handles = boost::make_shared<HandleArray>(handlesMessage(known, header));
  shells_.publish(shells);
  handles_.publish(handles);
  selection_.update(known, config, header);
  hand_poses_.publish(boost::make_shared<geometry_msgs::PoseArray>(handPosesMessage(known, header)));
  markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(
      localization_markers_.update(localization.shells, known, config, header, workspace_frame)));

  auto statistics = boost::make_shared<LocalizationStatistics>(statisticsMessage(localization, config, header));
  statistics->clouds_processed = processed_;
  statistics->clouds_rejected = rejected_;
  statistics->clouds_without_transform = untransformed_;
  {
    const std::lock_guard<std::mutex> lock(counters_mutex_);
    statistics->clouds_dropped = dropped_;
    statistics->clouds_left_out = left_out_;
    statistics->clouds_received = received_;
  }
  statistics->milliseconds_latency = std::chrono::duration<double, std::milli>(Clock::now() - arrival).count();
  statistics_.publish(statistics);
  return {shells, handles, statistics};
}

}  // namespace grasp_affordances
