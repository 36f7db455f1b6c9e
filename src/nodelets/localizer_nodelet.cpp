#include "grasp_affordances/CylindricalShellArray.h"
#include "grasp_affordances/LocalizationStatistics.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "nodelets/conversions.h"
#include "nodelets/markers.h"
#include "nodelets/newest_only_worker.h"
#include "nodelets/parameters_ros.h"

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>
#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kThrottlePeriod = 5.0;  // s between repetitions of a complaint

// Clouds that arrive in one burst are told apart, and counted, here and not in the subscriber's queue.
constexpr std::uint32_t kSubscriberQueue = 5;

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines) {
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

}  // namespace

/// Localizes enveloping grasp affordances in the newest of the clouds that arrive.
///
/// Subscribed: points (sensor_msgs/PointCloud2), camera_info (sensor_msgs/CameraInfo, optional).
/// Published, for every processed cloud and with its stamp and frame: ~shells (CylindricalShellArray),
/// ~markers (visualization_msgs/MarkerArray), ~statistics (LocalizationStatistics).
/// Parameters: see NodeParameters.
class LocalizerNodelet : public nodelet::Nodelet
{
public:
  ~LocalizerNodelet() override
  {
    // In this order: no more clouds come in, then the last one is finished while its publishers still exist.
    {
      const std::lock_guard<std::mutex> lock(subscriptions_mutex_);
      closing_ = true;
      points_.shutdown();
      camera_info_.shutdown();
    }
    worker_.reset();
  }

private:
  using Camera = sensor_msgs::CameraInfoConstPtr;
  using Points = sensor_msgs::PointCloud2ConstPtr;

  void onInit() override;
  void updateSubscriptions();
  bool anybodyListens() const;

  using Clock = std::chrono::steady_clock;

  struct Arrival
  {
    Points message;
    Clock::time_point time;
  };

  void receive(const Points& message);
  void process(const Arrival& arrival);
  std::optional<PinholeIntrinsics> knownIntrinsics(const Cloud& cloud);
  void publish(const Localization& localization, const Arrival& arrival);

  bool lazy_ = true;
  std::mutex subscriptions_mutex_;  // guards the publishers, the subscribers and closing_
  bool closing_ = false;            // a connection that is under way must not subscribe again
  ros::Publisher shells_;
  ros::Publisher markers_;
  ros::Publisher statistics_;
  ros::Subscriber points_;
  ros::Subscriber camera_info_;

  std::mutex camera_mutex_;
  Camera camera_;  // the latest, null before the first

  std::mutex counters_mutex_;  // guards received_ and dropped_, which are read and written together
  std::uint64_t received_ = 0;
  std::uint64_t dropped_ = 0;

  // Of the worker's thread.
  std::unique_ptr<Localizer> localizer_;
  Cloud cloud_;
  Localization localization_;
  ShellMarkers shell_markers_;
  std::uint64_t processed_ = 0;
  std::uint64_t rejected_ = 0;

  std::unique_ptr<NewestOnlyWorker<Arrival>> worker_;
};

void LocalizerNodelet::onInit()
{
  ros::NodeHandle& private_nh = getPrivateNodeHandle();
  try {
    const NodeParameters parameters = nodeParameters(private_nh);
    lazy_ = parameters.lazy;
    localizer_ = std::make_unique<Localizer>(parameters.config);
  } catch (const ParameterError& error) {
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  worker_ = std::make_unique<NewestOnlyWorker<Arrival>>([this](const Arrival& arrival) { process(arrival); });

  const auto changed = [this](const ros::SingleSubscriberPublisher&) { updateSubscriptions(); };
  {
    // Somebody may connect to a publisher, in another thread, before advertise() has returned it or before the next
    // one exists: the callback has to wait for all of them.
    const std::lock_guard<std::mutex> lock(subscriptions_mutex_);
    shells_ = private_nh.advertise<CylindricalShellArray>("shells", 1, changed, changed);
    markers_ = private_nh.advertise<visualization_msgs::MarkerArray>("markers", 1, changed, changed);
    statistics_ = private_nh.advertise<LocalizationStatistics>("statistics", 1, changed, changed);
  }
  updateSubscriptions();
}

bool LocalizerNodelet::anybodyListens() const
{
  return shells_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0 || statistics_.getNumSubscribers() > 0;
}

void LocalizerNodelet::updateSubscriptions()
{
  const std::lock_guard<std::mutex> lock(subscriptions_mutex_);
  if (closing_) {
    return;
  }
  if (lazy_ && !anybodyListens()) {
    points_.shutdown();
    camera_info_.shutdown();
  } else if (!points_) {
    ros::NodeHandle& nh = getNodeHandle();
    // Absolute names: nodelet's node handle takes the root namespace for that of the manager.
    const std::string parent = ros::names::parentNamespace(getName());
    camera_info_ = nh.subscribe<sensor_msgs::CameraInfo>(ros::names::append(parent, "camera_info"), 1,
                                                         [this](const Camera& message) {
                                                           const std::lock_guard<std::mutex> camera_lock(camera_mutex_);
                                                           camera_ = message;
                                                         });
    points_ = nh.subscribe<sensor_msgs::PointCloud2>(ros::names::append(parent, "points"), kSubscriberQueue,
                                                     [this](const Points& message) { receive(message); });
  }
}

void LocalizerNodelet::receive(const Points& message)
{
  const Clock::time_point now = Clock::now();
  const std::lock_guard<std::mutex> lock(counters_mutex_);
  ++received_;
  dropped_ += worker_->put({message, now}) ? 1 : 0;
}

void LocalizerNodelet::process(const Arrival& arrival)
{
  try {
    cloudFromPointCloud2(*arrival.message, cloud_);
    cloud_.intrinsics = knownIntrinsics(cloud_);
    localizer_->localize(cloud_, localization_);
    ++processed_;
    publish(localization_, arrival);
  } catch (const std::exception& error) {  // CloudError, or no memory for what a cloud asks for
    ++rejected_;
    NODELET_ERROR_STREAM_THROTTLE(kThrottlePeriod, "cloud rejected: " << error.what());
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
    NODELET_WARN_STREAM_THROTTLE(kThrottlePeriod, "camera_info is ignored: " << error.what());
    return std::nullopt;
  }
}

void LocalizerNodelet::publish(const Localization& localization, const Arrival& arrival)
{
  if (!localization.warnings.empty()) {
    NODELET_WARN_STREAM_THROTTLE(kThrottlePeriod, joined(localization.warnings));
  }
  const std_msgs::Header& header = arrival.message->header;
  shells_.publish(boost::make_shared<CylindricalShellArray>(shellsMessage(localization, header)));
  markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(shell_markers_.update(localization, header)));

  auto statistics =
      boost::make_shared<LocalizationStatistics>(statisticsMessage(localization, localizer_->config(), header));
  statistics->clouds_processed = processed_;
  statistics->clouds_rejected = rejected_;
  {
    const std::lock_guard<std::mutex> lock(counters_mutex_);
    statistics->clouds_dropped = dropped_;
    statistics->clouds_received = received_;
  }
  statistics->milliseconds_latency = std::chrono::duration<double, std::milli>(Clock::now() - arrival.time).count();
  statistics_.publish(statistics);
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::LocalizerNodelet, nodelet::Nodelet)
