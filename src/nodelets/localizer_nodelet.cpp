#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "nodelets/conversions.h"
#include "nodelets/localization_outputs.h"
#include "nodelets/newest_only_worker.h"
#include "nodelets/parameters_ros.h"
#include "nodelets/throttle.h"

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <pluginlib/class_list_macros.hpp>

#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

namespace grasp_affordances
{
namespace
{

// Clouds that arrive in one burst are told apart, and counted, here and not in the subscriber's queue.
constexpr std::uint32_t kSubscriberQueue = 5;

}  // namespace

/// Localizes enveloping grasp affordances in the newest of the clouds that arrive.
///
/// Subscribed: points (sensor_msgs/PointCloud2), camera_info (sensor_msgs/CameraInfo, optional).
/// Published, for every processed cloud and with its stamp and frame: see LocalizationOutputs.
/// Parameters: see NodeParameters.
class LocalizerNodelet : public nodelet::Nodelet
{
public:
  ~LocalizerNodelet() override
  {
    // In this order: no more clouds come in, then the last one is finished while its publishers still exist.
    outputs_.close();
    worker_.reset();
  }

private:
  using Camera = sensor_msgs::CameraInfoConstPtr;
  using Points = sensor_msgs::PointCloud2ConstPtr;

  struct Arrival
  {
    Points message;
    LocalizationOutputs::Clock::time_point time;
  };

  void onInit() override;
  void subscribe();
  void unsubscribe();
  void receive(const Points& message);
  void process(const Arrival& arrival);
  std::optional<PinholeIntrinsics> knownIntrinsics(const Cloud& cloud);

  LocalizationOutputs outputs_;
  ros::Subscriber points_;
  ros::Subscriber camera_info_;

  std::mutex camera_mutex_;
  Camera camera_;  // the latest, null before the first

  // Of the worker's thread.
  std::unique_ptr<Localizer> localizer_;
  Cloud cloud_;
  Localization localization_;
  Throttle ignored_cameras_;

  std::unique_ptr<NewestOnlyWorker<Arrival>> worker_;
};

void LocalizerNodelet::onInit()
{
  ros::NodeHandle& private_nh = getPrivateNodeHandle();
  bool lazy = true;
  try {
    const NodeParameters parameters = nodeParameters(private_nh);
    lazy = parameters.lazy;
    localizer_ = std::make_unique<Localizer>(parameters.config);
  } catch (const ParameterError& error) {
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  worker_ = std::make_unique<NewestOnlyWorker<Arrival>>([this](const Arrival& arrival) { process(arrival); });
  outputs_.advertise(
      private_nh, getName(), lazy, [this] { subscribe(); }, [this] { unsubscribe(); });
}

void LocalizerNodelet::subscribe()
{
  ros::NodeHandle& nh = getNodeHandle();
  // Absolute names: nodelet's node handle takes the root namespace for that of the manager.
  const std::string parent = ros::names::parentNamespace(getName());
  camera_info_ = nh.subscribe<sensor_msgs::CameraInfo>(ros::names::append(parent, "camera_info"), 1,
                                                       [this](const Camera& message) {
                                                         const std::lock_guard<std::mutex> lock(camera_mutex_);
                                                         camera_ = message;
                                                       });
  points_ = nh.subscribe<sensor_msgs::PointCloud2>(ros::names::append(parent, "points"), kSubscriberQueue,
                                                   [this](const Points& message) { receive(message); });
}

void LocalizerNodelet::unsubscribe()
{
  points_.shutdown();
  camera_info_.shutdown();
}

void LocalizerNodelet::receive(const Points& message)
{
  const LocalizationOutputs::Clock::time_point now = LocalizationOutputs::Clock::now();
  outputs_.receive([&] { return worker_->put({message, now}); });
}

void LocalizerNodelet::process(const Arrival& arrival)
{
  try {
    cloudFromPointCloud2(*arrival.message, cloud_);
    cloud_.intrinsics = knownIntrinsics(cloud_);
    localizer_->localize(cloud_, localization_);
    outputs_.publish(localization_, localizer_->config(), arrival.message->header, arrival.time);
  } catch (const std::exception& error) {  // CloudError, or no memory for what a cloud asks for
    outputs_.reject(error.what());
  }
}

std::optional<PinholeIntrinsics> LocalizerNodelet::knownIntrinsics(const Cloud& cloud)
{
  Camera camera;
  {
    const std::lock_guard<std::mutex> lock(camera_mutex_);
    camera = camera_;
  }
  if (!camera || !cloud.organized()) {
    return std::nullopt;
  }
  try {
    return intrinsicsFromCameraInfo(*camera, cloud.width, cloud.height);
  } catch (const std::invalid_argument& error) {
    if (ignored_cameras_.due()) {
      NODELET_WARN_STREAM("camera_info is ignored: " << error.what());
    }
    return std::nullopt;
  }
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::LocalizerNodelet, nodelet::Nodelet)
