#include "grasp_affordances/Localize.h"
#include "grasp_affordances/RegionOfInterest.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "nodelets/localizer/camera_info_input.h"
#include "nodelets/localizer/localization_outputs.h"
#include "nodelets/localizer/localize_service.h"
#include "nodelets/localizer/next_cloud.h"
#include "nodelets/messages/conversions.h"
#include "nodelets/messages/region_of_interest.h"
#include "nodelets/parameters/parameters_ros.h"
#include "nodelets/parameters/reconfiguration.h"
#include "nodelets/roscpp/callback_gate.h"
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
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace grasp_affordances
{
namespace
{

// Clouds that arrive in one burst are told apart, and counted, here and not in the subscriber's queue.
constexpr std::uint32_t kSubscriberQueue = 5;

// s at least that a call waits for the transforms of its region, as it may be the first one to need any.
constexpr double kRegionTimeout = 1.0;

double milliseconds(LocalizationOutputs::Clock::duration duration)
{
  return std::chrono::duration<double, std::milli>(duration).count();
}

/// The projection of the cloud that a call brings; nothing where it brings none.
/// @throw std::invalid_argument for one that does not fit
std::optional<PinholeIntrinsics> intrinsicsOfCall(const sensor_msgs::CameraInfo& camera, const Cloud& cloud)
{
  if (!cloud.organized() || (camera.width == 0 && camera.height == 0)) {
    return std::nullopt;
  }
  try {
    return intrinsicsFromCameraInfo(camera, cloud.width, cloud.height);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("the camera_info does not fit: ") + error.what());
  }
}

}  // namespace

/// Localizes enveloping grasp affordances in the newest of the clouds that arrive.
///
/// Subscribed: points (sensor_msgs/PointCloud2), camera_info (sensor_msgs/CameraInfo, optional); /tf and /tf_static
/// where a parameter names a frame or clouds are localized in on demand, else from the first call on whose region does.
/// Published, for every processed cloud, with its stamp and in its frame or the target frame: see LocalizationOutputs.
/// Services: see NextCloud (~trigger), LocalizeService (~localize) and Reconfiguration. ~localize has a localizer of
/// its own: it neither waits for the clouds that arrive nor holds them up, and takes part of the processor from them.
/// Parameters: see NodeParameters.
class LocalizerNodelet : public nodelet::Nodelet
{
public:
  ~LocalizerNodelet() override
  {
    // In this order: no more clouds come in, and nobody waits; services end; then the last cloud is given up while its
    // publishers still exist.
    ending_ = true;
    outputs_.close();
    gate_.close();
    if (transforms_) {  // it started
      transforms_->close();
    }
    next_cloud_.close();
    localize_service_.close();
    reconfiguration_.close();
    worker_.reset();
  }

private:
  using Points = sensor_msgs::PointCloud2ConstPtr;

  struct Arrival
  {
    Points message;
    LocalizationOutputs::Clock::time_point time;
  };

  /// What one thread localizes with.
  struct Workplace
  {
    Localizer localizer;
    Cloud cloud;
    Localization localization;
  };

  void onInit() override;
  std::string pointsTopic();
  void subscribe();
  void unsubscribe();
  void receive(const Points& message);
  void process(const Arrival& arrival);
  void localize(const Arrival& arrival, const std::optional<RegionOfInterest>& call);
  void answer(const Localize::Request& request, Localize::Response& response);
  std_msgs::Header localize(const std_msgs::Header& cloud_header, const Config& config, const RegionOfInterest& region,
                            Workplace& at);
  Eigen::Isometry3d transform(const std::string& frame, const std_msgs::Header& header, Transforms::Deadline deadline);
  std::unique_ptr<Workplace> workplace(const Config& config) const;

  NameClaim name_claim_;
  NodeParameters parameters_;
  LocalizationOutputs outputs_;
  ros::WallTimer clock_complaint_;
  std::unique_ptr<Transforms> transforms_;
  ros::Subscriber points_;
  CameraInfoInput camera_info_;

  // Of the callback for clouds.
  TimeJumps time_jumps_;
  Throttle reported_jumps_;
  std::optional<RateLimiter> rate_limiter_;

  std::atomic<bool> ending_{false};
  std::unique_ptr<Workplace> own_place_;      // of the worker's thread
  std::unique_ptr<Workplace> service_place_;  // of the thread of ~localize, from its first call on

  NextCloud next_cloud_;
  LocalizeService localize_service_;
  Reconfiguration reconfiguration_;

  std::unique_ptr<NewestOnlyWorker<Arrival>> worker_;
  CallbackGate gate_;  // of clouds
};

void LocalizerNodelet::onInit()
{
  ros::NodeHandle& private_nh = getPrivateNodeHandle();
  try {
    name_claim_.claim(getName());
    parameters_ = nodeParameters(private_nh);
    own_place_ = workplace(parameters_.config);
  } catch (const std::exception& error) {
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  clock_complaint_ = complainWithoutClock(getNodeHandle(), getName());
  transforms_ = std::make_unique<Transforms>(getNodeHandle());
  const auto named = [](const std::string& frame) { return !frame.empty(); };
  if (parameters_.on_demand || named(parameters_.workspace_frame) || named(parameters_.target_frame) ||
      named(parameters_.fixed_frame) || named(parameters_.approach_frame)) {
    transforms_->listen();
  }
  rate_limiter_.emplace(parameters_.max_rate);
  reconfiguration_.advertise(private_nh, getName(), parameters_.config);
  worker_ = std::make_unique<NewestOnlyWorker<Arrival>>([this](const Arrival& arrival) { process(arrival); });
  outputs_.advertise(
      private_nh, getName(), parameters_.lazy, parameters_.on_demand, [this] { subscribe(); },
      [this] { unsubscribe(); });
  next_cloud_.advertise(private_nh, "cloud on " + pointsTopic(),
                        [this](bool needed) { return outputs_.demand(needed); });
  localize_service_.advertise(private_nh, [this](const Localize::Request& request, Localize::Response& response) {
    answer(request, response);
  });
}

std::string LocalizerNodelet::pointsTopic()
{
  // Absolute names: nodelet's node handle takes the root namespace for that of the manager.
  return getNodeHandle().resolveName(ros::names::append(ros::names::parentNamespace(getName()), "points"));
}

void LocalizerNodelet::subscribe()
{
  ros::NodeHandle& nh = getNodeHandle();
  camera_info_.subscribe(nh, ros::names::append(ros::names::parentNamespace(getName()), "camera_info"));
  points_ = nh.subscribe<sensor_msgs::PointCloud2>(pointsTopic(), kSubscriberQueue,
                                                   gate_.guarded([this](const Points& message) { receive(message); }));
}

void LocalizerNodelet::unsubscribe()
{
  points_.shutdown();
  camera_info_.unsubscribe();
}

void LocalizerNodelet::receive(const Points& message)
{
  const LocalizationOutputs::Clock::time_point now = LocalizationOutputs::Clock::now();
  if (time_jumps_.wentBack(message->header.stamp)) {
    if (reported_jumps_.due()) {
      NODELET_INFO_STREAM("time goes back to " << message->header.stamp);
    }
    transforms_->restart();
  }
  const bool asked = next_cloud_.arrives(now);
  if (!asked &&
      (parameters_.on_demand || !rate_limiter_->passes(std::chrono::nanoseconds(now.time_since_epoch()).count()))) {
    outputs_.leaveOut();
    return;
  }
  outputs_.receive([&] { return worker_->put({message, now}); });
}

void LocalizerNodelet::process(const Arrival& arrival)
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

void LocalizerNodelet::localize(const Arrival& arrival, const std::optional<RegionOfInterest>& call)
{
  const RegionOfInterest region = call.value_or(RegionOfInterest());
  Config config = withRegion(reconfiguration_.config(), region);
  if (call) {
    config.tracking.min_hits = 1;  // who asks once is answered at once
  }
  cloudFromPointCloud2(*arrival.message, own_place_->cloud);
  own_place_->cloud.intrinsics = camera_info_.intrinsics(own_place_->cloud, getName());
  const std_msgs::Header header = localize(arrival.message->header, config, region, *own_place_);
  const FixedFrame fixed_frame{parameters_.fixed_frame, transform(parameters_.fixed_frame, header,
                                                                  Transforms::after(parameters_.transform_timeout))};
  const std::string workspace_frame = regionFrame(region, parameters_.workspace_frame);
  next_cloud_.answer(outputs_.publish(own_place_->localization, config, header, arrival.time,
                                      workspace_frame.empty() ? arrival.message->header.frame_id : workspace_frame,
                                      fixed_frame));
}

void LocalizerNodelet::answer(const Localize::Request& request, Localize::Response& response)
{
  const LocalizationOutputs::Clock::time_point start = LocalizationOutputs::Clock::now();
  const Config config = withRegion(reconfiguration_.config(), request.region);
  if (!service_place_) {
    service_place_ = workplace(config);
  }
  cloudFromPointCloud2(request.cloud, service_place_->cloud);
  service_place_->cloud.intrinsics = intrinsicsOfCall(request.camera_info, service_place_->cloud);
  const std_msgs::Header header = localize(request.cloud.header, config, request.region, *service_place_);
  const Localization& localization = service_place_->localization;
  response.shells = shellsMessage(localization, header).shells;
  response.handles = handlesMessage(localization.handles, header).handles;
  response.statistics = statisticsMessage(localization, config, header);
  response.statistics.milliseconds_latency = milliseconds(LocalizationOutputs::Clock::now() - start);
}

/// One whose work is given up when the node ends, of which ROS tells nobody who waits for a service.
std::unique_ptr<LocalizerNodelet::Workplace> LocalizerNodelet::workplace(const Config& config) const
{
  auto result = std::make_unique<Workplace>(Workplace{Localizer(config), {}, {}});
  result->localizer.cancelWhen([this] { return ending_ || ros::isShuttingDown(); });
  return result;
}

/// In the cloud at a workplace. Returns the header of what is found.
std_msgs::Header LocalizerNodelet::localize(const std_msgs::Header& cloud_header, const Config& config,
                                            const RegionOfInterest& region, Workplace& at)
{
  std_msgs::Header header = cloud_header;
  const double timeout =
      hasRegion(region) ? std::max(parameters_.transform_timeout, kRegionTimeout) : parameters_.transform_timeout;
  const Transforms::Deadline deadline = Transforms::after(timeout);
  const Eigen::Isometry3d T_workspace_cloud =
      transform(regionFrame(region, parameters_.workspace_frame), header, deadline);
  const Eigen::Isometry3d T_target_cloud = transform(parameters_.target_frame, header, deadline);
  const Eigen::Isometry3d T_approach_cloud = transform(parameters_.approach_frame, header, deadline);

  at.localizer.configure(config);
  at.localizer.localize(at.cloud, at.localization, T_workspace_cloud, T_approach_cloud);
  if (!parameters_.target_frame.empty()) {
    for (Shell& shell : at.localization.shells) {
      shell = transformed(shell, T_target_cloud);
    }
    for (GraspHandle& handle : at.localization.handles) {
      handle = transformed(std::move(handle), T_target_cloud);
    }
    header.frame_id = parameters_.target_frame;
  }
  return header;
}

Eigen::Isometry3d LocalizerNodelet::transform(const std::string& frame, const std_msgs::Header& header,
                                              Transforms::Deadline deadline)
{
  if (frame.empty()) {
    return Eigen::Isometry3d::Identity();
  }
  return transforms_->lookup(frame, header.frame_id, header.stamp, deadline);
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::LocalizerNodelet, nodelet::Nodelet)
