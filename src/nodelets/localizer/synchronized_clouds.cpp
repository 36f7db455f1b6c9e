#include "nodelets/localizer/synchronized_clouds.h"

#include "core/cloud/usable_cloud.h"
#include "grasp_affordances/point_cloud2.h"
#include "nodelets/localizer/input_topic.h"
#include "nodelets/localizer/silence.h"
#include "nodelets/roscpp/frame_name.h"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace grasp_affordances
{
namespace
{

/// Whether a cloud is in the optical frame of the sensor that measured it.
bool isInSensorFrame(const Cloud& cloud)
{
  UsableCloud usable;
  usable.update(cloud);
  return usable.image().has_value();
}

}  // namespace

SynchronizedClouds::SynchronizedClouds(const ros::NodeHandle& node_handle, const std::string& name,
                                       const MultiCameraParameters& parameters)
    : name_(name),
      target_frame_(parameters.node.target_frame),
      sync_slop_(parameters.sync_slop),
      node_handle_(node_handle),
      synchronizer_(parameters.views, parameters.sync_slop, [this](const CloudSynchronizer::Set& clouds) {
        latest_set_ = std::chrono::steady_clock::now();
        receiver_.receive(clouds);
      })
{
  for (std::uint32_t i = 1; i <= parameters.views; ++i) {
    View& view = views_.emplace_back();
    view.points_topic = inputTopic(node_handle, name, "points_" + std::to_string(i));
    view.camera_info_topic = inputTopic(node_handle, name, "camera_info_" + std::to_string(i));
  }
}

void SynchronizedClouds::subscribe(const Receiver& receiver)
{
  receiver_ = receiver;
  synchronizer_.restart();
  latest_set_ = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < views_.size(); ++i) {
    views_[i].pace.begin(latest_set_);
    views_[i].camera_info.subscribe(node_handle_, views_[i].camera_info_topic);
    views_[i].points = node_handle_.subscribe<sensor_msgs::PointCloud2>(
        views_[i].points_topic, kCloudQueue,
        gate_.guarded([this, i](const sensor_msgs::PointCloud2ConstPtr& message) { receive(i, message); }));
  }
  silence_ = node_handle_.createWallTimer(ros::WallDuration(kSilence),
                                          [this](const ros::WallTimerEvent&) { complainOfSilence(); });
}

void SynchronizedClouds::unsubscribe()
{
  silence_.stop();
  for (View& view : views_) {
    view.points.shutdown();
    view.camera_info.unsubscribe();
  }
}

void SynchronizedClouds::close()
{
  gate_.close();
}

void SynchronizedClouds::receive(std::size_t view, const sensor_msgs::PointCloud2ConstPtr& message)
{
  if (views_[view].time_jumps.wentBack(message->header.stamp)) {
    startAgain(message->header.stamp);
  }
  views_[view].newest = message->header.stamp;
  views_[view].pace.arrive(std::chrono::steady_clock::now());
  const ros::Time time = timeOf(view, message->header.stamp);
  synchronizer_.add(view, message, time);
}

/// The time by which a cloud that has just arrived is put together with others.
ros::Time SynchronizedClouds::timeOf(std::size_t view, const ros::Time& stamp)
{
  const CloudClock::Arrival now = std::chrono::steady_clock::now();
  views_[view].clock.read(stamp, now);
  const bool by_arrival =
      std::any_of(views_.begin(), views_.end(), [](const View& any) { return any.clock.countsArrivals(); });
  if (by_arrival != by_arrival_) {
    by_arrival_ = by_arrival;
    synchronizer_.restart();
  }
  if (!by_arrival) {
    return stamp;
  }
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(std::chrono::nanoseconds(now.time_since_epoch()).count()));
  return time;
}

/// Once for all cameras: the first one whose time goes back speaks for the others.
void SynchronizedClouds::startAgain(const ros::Time& stamp)
{
  forgetTimes();
  receiver_.time_is_back(stamp);
}

void SynchronizedClouds::forgetTimes()
{
  for (View& view : views_) {
    view.time_jumps = TimeJumps(ros::Duration(kDisorder));
    view.clock = CloudClock();
  }
  by_arrival_ = false;
  synchronizer_.restart();
}

void SynchronizedClouds::complainOfSilence()
{
  const CloudPace::Time now = std::chrono::steady_clock::now();
  if (const std::string silent = silentCameras(now); !silent.empty()) {
    ROS_WARN_STREAM_NAMED(name_, "nothing is localized: no clouds arrive on " << silent);
    return;
  }
  ros::Time earliest = ros::TIME_MAX, latest;
  double patience = 0.0;
  for (const View& view : views_) {
    earliest = std::min(earliest, view.newest);
    latest = std::max(latest, view.newest);
    patience = std::max(patience, view.pace.patience());
  }
  const bool sets_are_overdue = std::chrono::duration<double>(now - latest_set_).count() >= patience;
  if (const double difference = latest.toSec() - earliest.toSec(); sets_are_overdue && difference > sync_slop_) {
    ROS_WARN_STREAM_NAMED(name_, "nothing is localized: the stamps of the newest clouds differ by "
                                     << difference << " s, which is more than sync_slop, " << sync_slop_ << " s");
  }
}

/// Those whose clouds are overdue, joined by commas. One cloud of each camera may be all that there is.
std::string SynchronizedClouds::silentCameras(CloudPace::Time now) const
{
  const bool go_on = std::any_of(views_.begin(), views_.end(), [](const View& any) { return any.pace.arrivals() > 1; });
  std::string silent;
  for (const View& view : views_) {
    if (view.pace.isOverdue(now) && (go_on || view.pace.arrivals() == 0)) {
      silent += (silent.empty() ? "" : ", ") + describeSilence(view.points, view.pace, now);
    }
  }
  return silent;
}

/// Two sensors cannot be in one place. Clouds that were brought into a common frame before may share it.
void SynchronizedClouds::complainOfSharedFrames(const Clouds& messages)
{
  for (std::size_t i = 1; i < views_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::string frame = frameName(messages[i]->header.frame_id);
      if (frame == frameName(messages[j]->header.frame_id) && isInSensorFrame(views_[i].cloud) &&
          isInSensorFrame(views_[j].cloud)) {
        ROS_ERROR_STREAM_NAMED(name_, views_[j].points_topic
                                          << " and " << views_[i].points_topic << " both have the frame '" << frame
                                          << "': handles are wrong unless each camera has an optical frame of its own");
      }
    }
  }
}

CloudInput::Gathered SynchronizedClouds::gather(const Clouds& messages)
{
  Gathered result;
  result.header.frame_id = target_frame_;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    View& view = views_[i];
    try {
      cloudFromPointCloud2(*messages[i], view.cloud);
    } catch (const CloudError& error) {
      throw CloudError(view.points_topic + ": " + error.what());
    }
    view.cloud.intrinsics = view.camera_info.intrinsics(view.cloud, name_);
    result.clouds.push_back(&view.cloud);
    result.header.stamp = std::max(result.header.stamp, messages[i]->header.stamp);
  }
  if (shared_frames_.due()) {
    complainOfSharedFrames(messages);
  }
  return result;
}

}  // namespace grasp_affordances
