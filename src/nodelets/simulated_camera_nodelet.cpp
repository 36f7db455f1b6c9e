#include "grasp_affordances/config.h"
#include "nodelets/newest_only_worker.h"
#include "nodelets/simulated_camera_parameters.h"
#include "simulation/camera_orbit.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <geometry_msgs/TransformStamped.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/Header.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <Eigen/Geometry>
#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// The frames of an Xtion as openni2_launch publishes them: x forward, y left, z up, with the depth camera 2 cm to the
/// right of the middle. Optical frames: x right, y down, z forward.
const Eigen::Isometry3d kT_link_depth(Eigen::Translation3d(0.0, -0.02, 0.0));
const Eigen::Isometry3d kT_depth_optical(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5));

geometry_msgs::TransformStamped transformMessage(const std::string& parent, const Eigen::Isometry3d& T_parent_child,
                                                 const std::string& child, const ros::Time& stamp)
{
  const Eigen::Vector3d translation = T_parent_child.translation();
  const Eigen::Quaterniond rotation(T_parent_child.linear());
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation.x = translation.x();
  message.transform.translation.y = translation.y();
  message.transform.translation.z = translation.z();
  message.transform.rotation.x = rotation.x();
  message.transform.rotation.y = rotation.y();
  message.transform.rotation.z = rotation.z();
  message.transform.rotation.w = rotation.w();
  return message;
}

sensor_msgs::CameraInfoPtr cameraInfoMessage(const XtionModel& model, const std_msgs::Header& header)
{
  const PinholeIntrinsics& camera = model.intrinsics;
  auto message = boost::make_shared<sensor_msgs::CameraInfo>();
  message->header = header;
  message->width = model.width;
  message->height = model.height;
  message->distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  message->D.assign(5, 0.0);
  message->K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message->R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message->P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

/// REP 118: depth in millimetres, 0 where nothing was measured.
sensor_msgs::ImagePtr depthMessage(const Frame& frame, const std_msgs::Header& header)
{
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->width = frame.cloud.width;
  message->height = frame.cloud.height;
  message->encoding = sensor_msgs::image_encodings::TYPE_16UC1;
  message->step = message->width * sizeof(std::uint16_t);
  message->data.resize(frame.depth.size() * sizeof(std::uint16_t));
  std::memcpy(message->data.data(), frame.depth.data(), message->data.size());
  return message;
}

sensor_msgs::PointCloud2Ptr pointsMessage(const Cloud& cloud, const std_msgs::Header& header)
{
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header = header;
  message->width = cloud.width;
  message->height = cloud.height;
  message->is_dense = false;
  sensor_msgs::PointCloud2Modifier(*message).setPointCloud2FieldsByString(1, "xyz");
  sensor_msgs::PointCloud2Iterator<float> xyz(*message, "x");
  for (std::size_t i = 0; i < cloud.size(); ++i, ++xyz) {
    xyz[0] = cloud.x[i];
    xyz[1] = cloud.y[i];
    xyz[2] = cloud.z[i];
  }
  return message;
}

}  // namespace

/// Publishes what a virtual Xtion sees of a scene, as openni2_launch does for a real one.
///
/// Published, with one stamp and in the frame CAMERA_depth_optical_frame, while somebody listens to any of them:
/// depth/camera_info (sensor_msgs/CameraInfo), depth/image_raw (sensor_msgs/Image, 16UC1, mm) and depth/points
/// (sensor_msgs/PointCloud2, organized). Always: the transforms from the world to CAMERA_link, CAMERA_depth_frame and
/// CAMERA_depth_optical_frame.
/// Parameters: see SimulatedCameraParameters.
class SimulatedCameraNodelet : public nodelet::Nodelet
{
public:
  ~SimulatedCameraNodelet() override
  {
    // In this order: no more frames are asked for, then the last one is finished while its publishers still exist.
    timer_.stop();
    worker_.reset();
  }

private:
  void onInit() override;
  void publishFixedTransforms();
  geometry_msgs::TransformStamped linkTransform(const ros::Time& stamp) const;
  Eigen::Isometry3d cameraPose(const ros::Time& stamp) const;  // T_world_optical
  bool anybodyListens() const;

  void tick(const ros::Time& stamp);
  void capture(const ros::Time& stamp);

  SimulatedCameraParameters parameters_;
  std::string link_frame_;
  std::string optical_frame_;
  View view_;
  std::optional<CameraOrbit> orbit_;  // none: the camera stands still
  const Xtion xtion_;

  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> fixed_transforms_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> transforms_;
  ros::Publisher camera_info_;
  ros::Publisher depth_;
  ros::Publisher points_;

  std::uint64_t frame_number_ = 0;  // of the worker's thread
  std::unique_ptr<NewestOnlyWorker<ros::Time>> worker_;
  ros::Timer timer_;
};

void SimulatedCameraNodelet::onInit()
{
  try {
    parameters_ = simulatedCameraParameters(getPrivateNodeHandle());
    view_ = makeScene(parameters_.scene, parameters_.seed);
  } catch (const std::exception& error) {
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  link_frame_ = parameters_.camera + "_link";
  optical_frame_ = parameters_.camera + "_depth_optical_frame";
  if (parameters_.motion == "orbit") {
    orbit_.emplace(view_, kDegree * parameters_.amplitude_deg, parameters_.period_s);
  }

  ros::NodeHandle& nh = getNodeHandle();
  camera_info_ = nh.advertise<sensor_msgs::CameraInfo>("depth/camera_info", 1);
  depth_ = nh.advertise<sensor_msgs::Image>("depth/image_raw", 1);
  points_ = nh.advertise<sensor_msgs::PointCloud2>("depth/points", 1);
  publishFixedTransforms();

  worker_ = std::make_unique<NewestOnlyWorker<ros::Time>>([this](const ros::Time& stamp) { capture(stamp); });
  timer_ = nh.createTimer(ros::Duration(1.0 / parameters_.rate),
                          [this](const ros::TimerEvent& event) { tick(event.current_real); });
}

void SimulatedCameraNodelet::publishFixedTransforms()
{
  const ros::Time now = ros::Time::now();
  const std::string depth_frame = parameters_.camera + "_depth_frame";
  std::vector<geometry_msgs::TransformStamped> fixed = {
      transformMessage(link_frame_, kT_link_depth, depth_frame, now),
      transformMessage(depth_frame, kT_depth_optical, optical_frame_, now)};
  if (orbit_) {
    transforms_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  } else {
    fixed.push_back(linkTransform(now));
  }
  fixed_transforms_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
  fixed_transforms_->sendTransform(fixed);
}

geometry_msgs::TransformStamped SimulatedCameraNodelet::linkTransform(const ros::Time& stamp) const
{
  const Eigen::Isometry3d T_world_link = cameraPose(stamp) * (kT_link_depth * kT_depth_optical).inverse();
  return transformMessage(parameters_.world_frame, T_world_link, link_frame_, stamp);
}

Eigen::Isometry3d SimulatedCameraNodelet::cameraPose(const ros::Time& stamp) const
{
  return orbit_ ? orbit_->pose(stamp.toSec()) : view_.T_scene_camera;
}

bool SimulatedCameraNodelet::anybodyListens() const
{
  return camera_info_.getNumSubscribers() > 0 || depth_.getNumSubscribers() > 0 || points_.getNumSubscribers() > 0;
}

void SimulatedCameraNodelet::tick(const ros::Time& stamp)
{
  if (orbit_) {
    transforms_->sendTransform(linkTransform(stamp));
  }
  // Asked at every tick instead of being told of connections: the ticks go on for the transforms anyway, and nothing
  // needs a lock.
  if (anybodyListens()) {
    worker_->put(stamp);  // a frame that still waits is skipped
  }
}

void SimulatedCameraNodelet::capture(const ros::Time& stamp)
{
  const Frame frame = xtion_.capture(view_.scene, cameraPose(stamp), parameters_.seed + frame_number_++);
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = optical_frame_;
  camera_info_.publish(cameraInfoMessage(xtion_.model(), header));
  depth_.publish(depthMessage(frame, header));
  points_.publish(pointsMessage(frame.cloud, header));
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::SimulatedCameraNodelet, nodelet::Nodelet)
