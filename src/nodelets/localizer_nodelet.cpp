#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "nodelets/camera_info_input.h"
#include "nodelets/localization_outputs.h"
#include "nodelets/newest_only_worker.h"
#include "nodelets/parameters_ros.h"
#include "nodelets/ros_time.h"
#include "nodelets/throttle.h"
#include "nodelets/transforms.h"

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <tf2/exceptions.h>
#include <Eigen/Geometry>
#include <pluginlib/class_list_macros.hpp>

#include <cstdint>
#include <exception>
#include <memory>
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
/// Subscribed: points (sensor_msgs/PointCloud2), camera_info (sensor_msgs/CameraInfo, optional); /tf and /tf_static
/// where a parameter names a frame.
/// Published, for every processed cloud, with its stamp and in its frame or the target frame: see LocalizationOutputs.
/// Parameters: see NodeParameters.
class LocalizerNodelet : public nodelet::Nodelet
{
public:
  ~LocalizerNodelet() override
  {
    // In this order: no more clouds come in, then the last one is finished while its publishers still exist.
    outputs_.close();
    if (transforms_) {
      transforms_->close();
    }
    worker_.reset();
  }

private:
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
  void localize(const Arrival& arrival);
  Eigen::Isometry3d transform(const std::string& frame, const std_msgs::Header& header, Transforms::Deadline deadline);

  NodeParameters parameters_;
  LocalizationOutputs outputs_;
  ros::WallTimer clock_complaint_;
  std::unique_ptr<Transforms> transforms_;  // null where no parameter names a frame
  ros::Subscriber points_;
  CameraInfoInput camera_info_;

  // Of the callback for clouds.
  TimeJumps time_jumps_;
  Throttle reported_jumps_;

  // Of the worker's thread.
  std::unique_ptr<Localizer> localizer_;
  Cloud cloud_;
  Localization localization_;

  std::unique_ptr<NewestOnlyWorker<Arrival>> worker_;
};

void LocalizerNodelet::onInit()
{
  ros::NodeHandle& private_nh = getPrivateNodeHandle();
  try {
    parameters_ = nodeParameters(private_nh);
    localizer_ = std::make_unique<Localizer>(parameters_.config);
  } catch (const ParameterError& error) {
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  clock_complaint_ = complainWithoutClock(getNodeHandle(), getName());
  if (!parameters_.workspace_frame.empty() || !parameters_.target_frame.empty()) {
    transforms_ = std::make_unique<Transforms>(getNodeHandle());
  }
  worker_ = std::make_unique<NewestOnlyWorker<Arrival>>([this](const Arrival& arrival) { process(arrival); });
  outputs_.advertise(
      private_nh, getName(), parameters_.lazy, [this] { subscribe(); }, [this] { unsubscribe(); });
}

void LocalizerNodelet::subscribe()
{
  ros::NodeHandle& nh = getNodeHandle();
  // Absolute names: nodelet's node handle takes the root namespace for that of the manager.
  const std::string parent = ros::names::parentNamespace(getName());
  camera_info_.subscribe(nh, ros::names::append(parent, "camera_info"));
  points_ = nh.subscribe<sensor_msgs::PointCloud2>(ros::names::append(parent, "points"), kSubscriberQueue,
                                                   [this](const Points& message) { receive(message); });
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
    if (transforms_) {
      transforms_->restart();
    }
  }
  outputs_.receive([&] { return worker_->put({message, now}); });
}

void LocalizerNodelet::process(const Arrival& arrival)
{
  try {
    localize(arrival);
  } catch (const tf2::TransformException& error) {
    outputs_.leaveUntransformed(error.what());
  } catch (const std::exception& error) {  // CloudError, or no memory for what a cloud asks for
    outputs_.reject(error.what());
  }
}

void LocalizerNodelet::localize(const Arrival& arrival)
{
  std_msgs::Header header = arrival.message->header;
  cloudFromPointCloud2(*arrival.message, cloud_);
  cloud_.intrinsics = camera_info_.intrinsics(cloud_, getName());
  const Transforms::Deadline deadline = Transforms::after(parameters_.transform_timeout);
  const Eigen::Isometry3d T_workspace_cloud = transform(parameters_.workspace_frame, header, deadline);
  const Eigen::Isometry3d T_target_cloud = transform(parameters_.target_frame, header, deadline);

  localizer_->localize(cloud_, localization_, T_workspace_cloud);
  if (!parameters_.target_frame.empty()) {
    for (Shell& shell : localization_.shells) {
      shell = transformed(shell, T_target_cloud);
    }
    for (GraspHandle& handle : localization_.handles) {
      grasp_affordances::transform(T_target_cloud, handle);
    }
    header.frame_id = parameters_.target_frame;
  }
  outputs_.publish(
      localization_, localizer_->config(), header, arrival.time,
      parameters_.workspace_frame.empty() ? arrival.message->header.frame_id : parameters_.workspace_frame);
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
