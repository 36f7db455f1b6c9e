#include "grasp_affordances/RegionOfInterest.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "nodelets/localizer/camera_info_input.h"
#include "nodelets/localizer/localization_outputs.h"
#include "nodelets/localizer/next_cloud.h"
#include "nodelets/messages/region_of_interest.h"
#include "nodelets/parameters/parameters_ros.h"
#include "nodelets/parameters/reconfiguration.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/cloud_synchronizer.h"
#include "nodelets/roscpp/name_claim.h"
#include "nodelets/roscpp/newest_only_worker.h"
#include "nodelets/roscpp/rate_limiter.h"
#include "nodelets/roscpp/ros_time.h"
#include "nodelets/roscpp/throttle.h"
#include "nodelets/roscpp/transforms.h"

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <tf2/exceptions.h>
#include <Eigen/Geometry>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

// Clouds that arrive in one burst are told apart here and not in the subscriber's queue.
constexpr std::uint32_t kSubscriberQueue = 5;
constexpr double kSilence = 5.0;  // s of wall-clock time without clouds that belong together

}  // namespace

/// Localizes enveloping grasp affordances in what several cameras see at the same time, in a common frame: the newest
/// set of clouds, one of each camera, whose stamps differ by little.
///
/// Subscribed: points_1, points_2, ... (sensor_msgs/PointCloud2), camera_info_1, ... (sensor_msgs/CameraInfo,
/// optional); /tf and /tf_static, which must lead from the target frame to each cloud's at its stamp. Published, for
/// every processed set, in the target frame and with the stamp of the newest cloud: see LocalizationOutputs.
/// Services: see NextCloud (~trigger), whose cloud is a set of clouds here, and Reconfiguration.
/// Parameters: see MultiCameraParameters.
class MultiCameraNodelet : public nodelet::Nodelet
{
public:
  ~MultiCameraNodelet() override
  {
    // In this order: no more clouds come in, and nobody waits; services end; then the last clouds are given up while
    // their publishers still exist.
    ending_ = true;
    outputs_.close();
    gate_.close();
    if (transforms_) {  // it started
      transforms_->close();
    }
    next_cloud_.close();
    reconfiguration_.close();
    worker_.reset();
  }

private:
  using Points = sensor_msgs::PointCloud2ConstPtr;

  struct View
  {
    std::string points_topic, camera_info_topic;
    ros::Subscriber points;
    CameraInfoInput camera_info;

    // Of the callbacks for clouds and of the timer, which take turns.
    TimeJumps time_jumps;
    Points newest;  // since the timer's last call

    Cloud cloud;  // of the worker's thread
  };

  struct Arrival
  {
    CloudSynchronizer::Set clouds;
    LocalizationOutputs::Clock::time_point time;
  };

  void onInit() override;
  void nameTopics();
  void subscribe();
  void unsubscribe();
  void receive(std::size_t view, const Points& message);
  void receive(const CloudSynchronizer::Set& clouds);
  void startAgain(const ros::Time& stamp);
  void complainOfSilence();
  void process(const Arrival& arrival);
  void localize(const Arrival& arrival, const std::optional<RegionOfInterest>& call);
  void convert(const sensor_msgs::PointCloud2& message, View& view);

  NameClaim name_claim_;
  MultiCameraParameters parameters_;
  LocalizationOutputs outputs_;
  ros::WallTimer clock_complaint_;
  std::unique_ptr<Transforms> transforms_;
  std::deque<View> views_;
  ros::WallTimer silence_;

  // Of the callbacks for clouds and of the timer.
  std::unique_ptr<CloudSynchronizer> synchronizer_;
  bool any_set_ = false;  // since the timer's last call
  Throttle reported_jumps_;
  std::optional<RateLimiter> rate_limiter_;

  std::atomic<bool> ending_{false};

  // Of the worker's thread.
  std::unique_ptr<Localizer> localizer_;
  std::vector<PosedCloud> posed_clouds_;
  Localization localization_;

  NextCloud next_cloud_;
  Reconfiguration reconfiguration_;

  std::unique_ptr<NewestOnlyWorker<Arrival>> worker_;
  CallbackGate gate_;  // of clouds
};

void MultiCameraNodelet::onInit()
{
  ros::NodeHandle& private_nh = getPrivateNodeHandle();
  try {
    name_claim_.claim(getName());
    parameters_ = multiCameraParameters(private_nh);
    localizer_ = std::make_unique<Localizer>(parameters_.node.config);
    localizer_->cancelWhen([this] { return ending_ || ros::isShuttingDown(); });
  } catch (const std::exception& error) {
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  nameTopics();
  posed_clouds_.resize(parameters_.views);
  synchronizer_ = std::make_unique<CloudSynchronizer>(
      parameters_.views, parameters_.sync_slop, [this](const CloudSynchronizer::Set& clouds) { receive(clouds); });
  clock_complaint_ = complainWithoutClock(getNodeHandle(), getName());
  transforms_ = std::make_unique<Transforms>(getNodeHandle());
  transforms_->listen();
  rate_limiter_.emplace(parameters_.node.max_rate);
  reconfiguration_.advertise(private_nh, getName(), parameters_.node.config);
  worker_ = std::make_unique<NewestOnlyWorker<Arrival>>([this](const Arrival& arrival) { process(arrival); });
  outputs_.advertise(
      private_nh, getName(), parameters_.node.lazy, parameters_.node.on_demand, [this] { subscribe(); },
      [this] { unsubscribe(); });
  next_cloud_.advertise(private_nh, "set of clouds", [this](bool needed) { return outputs_.demand(needed); });
}

void MultiCameraNodelet::nameTopics()
{
  // Absolute names: nodelet's node handle takes the root namespace for that of the manager.
  const std::string parent = ros::names::parentNamespace(getName());
  const auto topic = [&](const std::string& name) {
    return getNodeHandle().resolveName(ros::names::append(parent, name));
  };
  for (std::uint32_t i = 1; i <= parameters_.views; ++i) {
    View& view = views_.emplace_back();
    view.points_topic = topic("points_" + std::to_string(i));
    view.camera_info_topic = topic("camera_info_" + std::to_string(i));
  }
}

void MultiCameraNodelet::subscribe()
{
  ros::NodeHandle& nh = getNodeHandle();
  synchronizer_->restart();
  any_set_ = false;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    views_[i].newest.reset();
    views_[i].camera_info.subscribe(nh, views_[i].camera_info_topic);
    views_[i].points = nh.subscribe<sensor_msgs::PointCloud2>(
        views_[i].points_topic, kSubscriberQueue,
        gate_.guarded([this, i](const Points& message) { receive(i, message); }));
  }
  silence_ =
      nh.createWallTimer(ros::WallDuration(kSilence), [this](const ros::WallTimerEvent&) { complainOfSilence(); });
}

void MultiCameraNodelet::unsubscribe()
{
  silence_.stop();
  for (View& view : views_) {
    view.points.shutdown();
    view.camera_info.unsubscribe();
  }
}

void MultiCameraNodelet::receive(std::size_t view, const Points& message)
{
  if (views_[view].time_jumps.wentBack(message->header.stamp)) {
    startAgain(message->header.stamp);
  }
  views_[view].newest = message;
  synchronizer_->add(view, message);
}

void MultiCameraNodelet::receive(const CloudSynchronizer::Set& clouds)
{
  any_set_ = true;
  const LocalizationOutputs::Clock::time_point now = LocalizationOutputs::Clock::now();
  const bool asked = next_cloud_.arrives(now);
  if (!asked && (parameters_.node.on_demand ||
                 !rate_limiter_->passes(std::chrono::nanoseconds(now.time_since_epoch()).count()))) {
    outputs_.leaveOut();
    return;
  }
  outputs_.receive([&] { return worker_->put({clouds, now}); });
}

/// Once for all cameras: the first one whose time goes back speaks for the others.
void MultiCameraNodelet::startAgain(const ros::Time& stamp)
{
  if (reported_jumps_.due()) {
    NODELET_INFO_STREAM("time goes back to " << stamp);
  }
  for (View& view : views_) {
    view.time_jumps = TimeJumps();
  }
  synchronizer_->restart();
  transforms_->restart();
}

void MultiCameraNodelet::complainOfSilence()
{
  std::string silent;
  ros::Time earliest = ros::TIME_MAX, latest;
  for (View& view : views_) {
    if (view.newest) {
      earliest = std::min(earliest, view.newest->header.stamp);
      latest = std::max(latest, view.newest->header.stamp);
    } else {
      silent += (silent.empty() ? "" : ", ") + view.points_topic;
    }
    view.newest.reset();
  }
  if (!silent.empty()) {
    NODELET_WARN_STREAM("nothing is localized: no clouds arrive on " << silent);
  } else if (const double difference = latest.toSec() - earliest.toSec();
             !any_set_ && difference > parameters_.sync_slop) {
    NODELET_WARN_STREAM("nothing is localized: the stamps of the newest clouds differ by "
                        << difference << " s, which is more than sync_slop, " << parameters_.sync_slop << " s");
  }
  any_set_ = false;
}

void MultiCameraNodelet::process(const Arrival& arrival)
{
  const std::optional<RegionOfInterest> call = next_cloud_.take(arrival.time);
  try {
    localize(arrival, call);
  } catch (const tf2::TransformException& error) {
    outputs_.leaveUntransformed(error.what());
    next_cloud_.fail(error.what());
  } catch (const Cancelled& error) {
    next_cloud_.fail(error.what());
  } catch (const std::exception& error) {  // CloudError, or no memory for what a cloud asks for
    outputs_.reject(error.what());
    next_cloud_.fail(error.what());
  }
}

void MultiCameraNodelet::localize(const Arrival& arrival, const std::optional<RegionOfInterest>& call)
{
  const RegionOfInterest region = call.value_or(RegionOfInterest());
  Config config = withRegion(reconfiguration_.config(), region);
  if (call) {
    config.tracking.min_hits = 1;  // who asks once is answered at once
  }
  const NodeParameters& parameters = parameters_.node;
  const Transforms::Deadline deadline = Transforms::after(parameters.transform_timeout);
  std_msgs::Header header;
  header.frame_id = parameters.target_frame;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const sensor_msgs::PointCloud2& message = *arrival.clouds[i];
    convert(message, views_[i]);
    posed_clouds_[i] = {&views_[i].cloud,
                        transforms_->lookup(header.frame_id, message.header.frame_id, message.header.stamp, deadline)};
    header.stamp = std::max(header.stamp, message.header.stamp);
  }
  const auto transform_to = [&](const std::string& frame) {
    return frame.empty() ? Eigen::Isometry3d(Eigen::Isometry3d::Identity())
                         : transforms_->lookup(frame, header.frame_id, header.stamp, deadline);
  };
  const std::string workspace_frame = regionFrame(region, parameters.workspace_frame);
  const Eigen::Isometry3d T_workspace_target = transform_to(workspace_frame);
  const Eigen::Isometry3d T_approach_target = transform_to(parameters.approach_frame);
  const FixedFrame fixed_frame{parameters.fixed_frame, transform_to(parameters.fixed_frame)};
  localizer_->configure(config);
  localizer_->localize(posed_clouds_, localization_, T_workspace_target, T_approach_target);
  next_cloud_.answer(outputs_.publish(localization_, config, header, arrival.time,
                                      workspace_frame.empty() ? header.frame_id : workspace_frame, fixed_frame));
}

void MultiCameraNodelet::convert(const sensor_msgs::PointCloud2& message, View& view)
{
  try {
    cloudFromPointCloud2(message, view.cloud);
  } catch (const CloudError& error) {
    throw CloudError(view.points_topic + ": " + error.what());
  }
  view.cloud.intrinsics = view.camera_info.intrinsics(view.cloud, getName());
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::MultiCameraNodelet, nodelet::Nodelet)
