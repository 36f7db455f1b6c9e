#include "grasp_affordances/config.h"
#include "nodelets/cameras/camera_frames.h"
#include "nodelets/cameras/camera_messages.h"
#include "nodelets/cameras/simulated_camera_parameters.h"
#include "nodelets/roscpp/name_claim.h"
#include "nodelets/roscpp/newest_only_worker.h"
#include "simulation/background.h"
#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "simulation/sensor_model.h"

#include <geometry_msgs/TransformStamped.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <Eigen/Geometry>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// A frame to render or publish.
struct Shot
{
  ros::Time stamp;
  std::size_t number;  // index among the frames rendered ahead
};

}  // namespace

/// Simulates a depth camera, by default an Xtion, that looks at a scene. Topics and frames are those of openni2_launch
/// for a real Xtion.
///
/// Published while one of these topics has a subscriber: depth/camera_info (sensor_msgs/CameraInfo), depth/image_raw
/// (sensor_msgs/Image, 16UC1, mm) and depth/points (sensor_msgs/PointCloud2, organized). The three messages of a frame
/// have one stamp and the frame CAMERA_depth_optical_frame. Published always: the transforms from the world to
/// CAMERA_link, CAMERA_depth_frame and CAMERA_depth_optical_frame.
/// Parameters: see SimulatedCameraParameters.
class SimulatedCameraNodelet : public nodelet::Nodelet
{
public:
  ~SimulatedCameraNodelet() override
  {
    // The timer ends first, so that no new frame starts. Then the worker finishes its frame while its publishers exist.
    timer_.stop();
    closing_ = true;
    worker_.reset();
  }

private:
  void onInit() override;
  void publishFixedTransforms();
  geometry_msgs::TransformStamped linkTransform(const Shot& shot) const;
  Eigen::Isometry3d cameraPose(const Shot& shot) const;  // T_world_optical
  bool anybodyListens() const;

  void tick(const ros::Time& stamp);
  void take(const Shot& shot);
  FrameMessages render(const Shot& shot, std::uint64_t frame_number) const;
  void renderAhead();
  void publish(const FrameMessages& frame);

  NameClaim name_claim_;
  SimulatedCameraParameters parameters_;
  std::string link_frame_;
  std::string optical_frame_;
  View view_;
  std::optional<CameraOrbit> orbit_;  // none: the camera stands still
  DepthCamera camera_;

  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> fixed_transforms_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> transforms_;
  ros::Publisher camera_info_;
  ros::Publisher depth_;
  ros::Publisher points_;

  // Used by the worker's thread only.
  std::uint64_t frame_number_ = 0;
  std::vector<FrameMessages> frames_ahead_;

  std::atomic<bool> closing_{false};  // ends renderAhead()
  std::unique_ptr<NewestOnlyWorker<Shot>> worker_;
  std::size_t next_number_ = 0;  // used by the timer's callback only
  ros::Timer timer_;
};

void SimulatedCameraNodelet::onInit()
{
  try {
    name_claim_.claim(getName());
    parameters_ = simulatedCameraParameters(getPrivateNodeHandle());
    camera_ = DepthCamera(sensorModelFromNameOrFile(parameters_.sensor));
    const Background background = backgroundFromName(parameters_.background);
    view_ = viewFromAside(makeScene(parameters_.scene, parameters_.seed, background), kDegree * parameters_.turn_deg);
  } catch (const std::exception& error) {
    // The nodelet loader does not print the exception.
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());
    throw;
  }
  link_frame_ = parameters_.camera + "_link";
  optical_frame_ = opticalFrame(parameters_.camera, XtionCamera::depth);
  if (parameters_.motion == "orbit") {
    orbit_.emplace(view_, kDegree * parameters_.amplitude_deg, parameters_.period_s);
  }

  ros::NodeHandle& nh = getNodeHandle();
  camera_info_ = nh.advertise<sensor_msgs::CameraInfo>("depth/camera_info", 1);
  depth_ = nh.advertise<sensor_msgs::Image>("depth/image_raw", 1);
  points_ = nh.advertise<sensor_msgs::PointCloud2>("depth/points", 1);
  publishFixedTransforms();

  worker_ = std::make_unique<NewestOnlyWorker<Shot>>([this](const Shot& shot) { take(shot); });
  timer_ = nh.createTimer(ros::Duration(1.0 / parameters_.rate),
                          [this](const ros::TimerEvent& event) { tick(event.current_real); });
}

void SimulatedCameraNodelet::publishFixedTransforms()
{
  const ros::Time now = ros::Time::now();
  std::vector<geometry_msgs::TransformStamped> fixed = opticalTransforms(parameters_.camera, XtionCamera::depth, now);
  if (orbit_) {
    transforms_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  } else {
    fixed.push_back(linkTransform({now, 0}));
  }
  fixed_transforms_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
  fixed_transforms_->sendTransform(fixed);
}

geometry_msgs::TransformStamped SimulatedCameraNodelet::linkTransform(const Shot& shot) const
{
  const Eigen::Isometry3d T_world_link = cameraPose(shot) * opticalPoseInLink(XtionCamera::depth).inverse();
  return transformMessage(parameters_.world_frame, T_world_link, link_frame_, shot.stamp);
}

Eigen::Isometry3d SimulatedCameraNodelet::cameraPose(const Shot& shot) const
{
  if (!orbit_) {
    return view_.T_scene_camera;
  }
  // The frames rendered ahead make one orbit, so that the first frame follows the last one smoothly.
  return orbit_->pose(parameters_.frames_ahead > 0 ? parameters_.period_s * shot.number / parameters_.frames_ahead
                                                   : shot.stamp.toSec());
}

bool SimulatedCameraNodelet::anybodyListens() const
{
  return camera_info_.getNumSubscribers() > 0 || depth_.getNumSubscribers() > 0 || points_.getNumSubscribers() > 0;
}

void SimulatedCameraNodelet::tick(const ros::Time& stamp)
{
  const Shot shot{stamp, next_number_};
  if (parameters_.frames_ahead > 0) {
    next_number_ = (next_number_ + 1) % parameters_.frames_ahead;
  }
  if (orbit_) {
    transforms_->sendTransform(linkTransform(shot));
  }
  // Subscribers are counted at every tick. Connection callbacks would need a lock, and the timer runs anyway for the
  // transforms.
  if (anybodyListens()) {
    worker_->put(shot);  // a frame that still waits is dropped
  }
}

void SimulatedCameraNodelet::take(const Shot& shot)
{
  if (parameters_.frames_ahead == 0) {
    publish(render(shot, frame_number_++));
  } else if (frames_ahead_.size() < parameters_.frames_ahead) {
    renderAhead();  // this takes long, so that the shot is outdated afterwards; the next one is published
  } else {
    FrameMessages& frame = frames_ahead_[shot.number];
    restamp(frame, shot.stamp);
    publish(frame);
  }
}

FrameMessages SimulatedCameraNodelet::render(const Shot& shot, std::uint64_t frame_number) const
{
  std_msgs::Header header;
  header.stamp = shot.stamp;
  header.frame_id = optical_frame_;
  const std::uint64_t seed = parameters_.seed + parameters_.noise_seed + frame_number;
  const Frame frame = camera_.capture(view_.scene, cameraPose(shot), seed);
  return frameMessages(frame, camera_.model(), header);
}

void SimulatedCameraNodelet::renderAhead()
{
  NODELET_INFO_STREAM("rendering " << parameters_.frames_ahead << " frames ahead of time");
  while (frames_ahead_.size() < parameters_.frames_ahead && !closing_) {
    const std::size_t number = frames_ahead_.size();
    frames_ahead_.push_back(render({ros::Time(), number}, number));
  }
}

void SimulatedCameraNodelet::publish(const FrameMessages& frame)
{
  camera_info_.publish(frame.camera_info);
  depth_.publish(frame.depth);
  points_.publish(frame.points);
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::SimulatedCameraNodelet, nodelet::Nodelet)
