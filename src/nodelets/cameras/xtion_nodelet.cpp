#include "grasp_affordances/config.h"
#include "nodelets/cameras/camera_frames.h"
#include "nodelets/cameras/camera_stream.h"
#include "nodelets/cameras/device_diagnostics.h"
#include "nodelets/cameras/xtion_parameters.h"
#include "nodelets/roscpp/name_claim.h"
#include "openni2/device.h"
#include "openni2/device_error.h"
#include "openni2/lasting_thread.h"
#include "openni2/runtime.h"

#include <geometry_msgs/TransformStamped.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kThrottlePeriod = 5.0;           // s, shortest time between repeated warnings
constexpr std::chrono::milliseconds kPoll{100};   // longest wait for a frame before other events are checked
constexpr std::chrono::milliseconds kRetry{500};  // time between attempts to open the device
constexpr double kTimeoutsBeforeReopening = 4.0;  // a stalled device may recover when it is opened again

/// Why no more frames come.
enum class StreamEnd
{
  closing,
  disconnected,
  stalled,
  ended
};

}  // namespace

/// Driver for an OpenNI2 camera, such as an Asus Xtion, and for recordings of OpenNI2.
///
/// Published while a topic has a subscriber: depth/image_raw (sensor_msgs/Image, 16UC1, mm, 0: not measured, REP 118)
/// and depth/camera_info (sensor_msgs/CameraInfo); with color also rgb/image_raw (rgb8) and rgb/camera_info. Published
/// always: /diagnostics and, unless publish_tf is off, the static transforms between the camera's frames. Parameters:
/// see XtionParameters.
class XtionNodelet : public nodelet::Nodelet
{
public:
  ~XtionNodelet() override
  {
    // The thread must end while its publishers still exist.
    {
      const std::lock_guard<std::mutex> lock(closing_mutex_);
      closing_ = true;
    }
    closing_changed_.notify_all();
    thread_.join();
  }

private:
  void onInit() override;
  void advertise();
  void publishTransforms();

  void run();
  void open();
  StreamEnd serve();
  StreamEnd serveUntilEnd();
  bool goOnAfter(StreamEnd end);
  void complain(const std::exception& error);
  bool readFrame();                               // waits for at most kPoll; returns whether a frame came
  std::chrono::duration<double> silence() const;  // longest time without a frame among the running streams
  bool pause(std::chrono::milliseconds time);     // returns false if the nodelet ends

  NameClaim name_claim_;
  XtionParameters parameters_;
  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> transforms_;
  std::unique_ptr<DeviceDiagnostics> diagnostics_;
  std::unique_ptr<CameraCalibration> depth_calibration_;
  std::unique_ptr<CameraCalibration> rgb_calibration_;
  std::vector<std::unique_ptr<CameraStream>> streams_;

  std::mutex closing_mutex_;
  std::condition_variable closing_changed_;
  bool closing_ = false;

  // Used by the thread only.
  std::shared_ptr<OpenNi2Runtime> runtime_;  // kept also while there is no device, so that new devices are noticed
  std::unique_ptr<Device> device_;
  std::string last_complaint_;
  LastingThread thread_;
};

void XtionNodelet::onInit()
{
  try {
    name_claim_.claim(getName());
    parameters_ = xtionParameters(getPrivateNodeHandle());
  } catch (const std::exception& error) {
    // The nodelet loader does not print the exception.
    NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());
    throw;
  }
  advertise();
  if (parameters_.publish_tf) {
    publishTransforms();
  }
  thread_ = LastingThread([this] { run(); });
}

void XtionNodelet::advertise()
{
  // Absolute names: for a nodelet in the root namespace, the node handle resolves names in the manager's namespace.
  const std::string parent = ros::names::parentNamespace(getName());
  const ros::NodeHandle depth_nh(getNodeHandle(), ros::names::append(parent, "depth"));
  const ros::NodeHandle rgb_nh(getNodeHandle(), ros::names::append(parent, "rgb"));
  diagnostics_ = std::make_unique<DeviceDiagnostics>(getNodeHandle(), getName(), parameters_.diagnostic_period);
  depth_calibration_ = std::make_unique<CameraCalibration>(depth_nh, "depth", parameters_.depth_camera_info_url);
  rgb_calibration_ = std::make_unique<CameraCalibration>(rgb_nh, "rgb", parameters_.rgb_camera_info_url);

  const bool registered = parameters_.depth_registration;
  const std::string rgb_frame = opticalFrame(parameters_.camera, XtionCamera::rgb);
  CameraStream::Settings settings{registered ? rgb_frame : opticalFrame(parameters_.camera, XtionCamera::depth),
                                  parameters_.time_offset, parameters_.max_rate, parameters_.correction()};
  streams_.push_back(std::make_unique<CameraStream>(depth_nh, Sensor::depth, settings,
                                                    registered ? *rgb_calibration_ : *depth_calibration_,
                                                    diagnostics_->addStream("depth")));
  if (parameters_.color_mode) {
    settings.frame_id = rgb_frame;
    streams_.push_back(std::make_unique<CameraStream>(rgb_nh, Sensor::color, settings, *rgb_calibration_,
                                                      diagnostics_->addStream("rgb")));
  }
}

void XtionNodelet::publishTransforms()
{
  const ros::Time now = ros::Time::now();
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const XtionCamera camera : {XtionCamera::depth, XtionCamera::rgb}) {
    for (const geometry_msgs::TransformStamped& transform : opticalTransforms(parameters_.camera, camera, now)) {
      transforms.push_back(transform);
    }
  }
  transforms_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
  transforms_->sendTransform(transforms);
}

void XtionNodelet::run()
{
  bool goes_on = true;
  while (goes_on) {
    try {
      open();
      const StreamEnd end = serve();
      device_.reset();
      goes_on = goOnAfter(end);
    } catch (const std::exception& error) {  // DeviceError, or not enough memory for a frame
      device_.reset();
      complain(error);
      goes_on = pause(kRetry);
    }
  }
}

void XtionNodelet::open()
{
  if (!runtime_) {
    runtime_ = OpenNi2Runtime::get();
  }
  device_ = std::make_unique<Device>(DeviceRequest{parameters_.device_id, parameters_.depth_mode,
                                                   parameters_.color_mode, parameters_.depth_registration});
  diagnostics_->setDevice(device_->uri(), device_->serial());
  depth_calibration_->setDevice(*device_, Sensor::depth);
  rgb_calibration_->setDevice(*device_, Sensor::color);
  last_complaint_.clear();
  if (diagnostics_->state() != DeviceState::stalled && diagnostics_->setState(DeviceState::connected, "connected")) {
    NODELET_INFO_STREAM("connected to " << device_->uri()
                                        << (device_->serial().empty() ? "" : ", serial number " + device_->serial()));
  }
}

StreamEnd XtionNodelet::serve()
{
  try {
    return serveUntilEnd();
  } catch (const DeviceError& error) {
    // OpenNI2 may report an error before it reports that the device was unplugged.
    pause(kRetry);
    if (!device_->connected()) {
      return StreamEnd::disconnected;
    }
    if (diagnostics_->setState(DeviceState::stalled, std::string("stalled: ") + error.what())) {
      NODELET_WARN_STREAM(device_->uri() << " has stalled: " << error.what());
    }
    return StreamEnd::stalled;
  }
}

StreamEnd XtionNodelet::serveUntilEnd()
{
  const double reopening = kTimeoutsBeforeReopening * parameters_.frame_timeout;
  while (pause(std::chrono::milliseconds(0))) {
    diagnostics_->update();
    if (!device_->connected()) {
      return StreamEnd::disconnected;
    }
    for (const auto& stream : streams_) {
      stream->runIfWanted(*device_);
    }
    // Checked before reading: at the end of a recording some frames still wait to be read.
    const bool at_end = device_->atEnd();
    if (!readFrame() && at_end) {
      return StreamEnd::ended;
    }
    if (silence().count() > reopening && !device_->isRecording()) {
      return StreamEnd::stalled;
    }
  }
  return StreamEnd::closing;
}

bool XtionNodelet::readFrame()
{
  const auto runs = [this](const auto& stream) { return device_->runs(stream->sensor()); };
  if (std::none_of(streams_.begin(), streams_.end(), runs)) {
    pause(kPoll);
    return false;
  }
  const std::optional<DeviceFrame> frame = device_->read(kPoll);
  if (frame) {
    const auto takes = [&](const auto& stream) { return stream->sensor() == frame->sensor; };
    const auto stream = std::find_if(streams_.begin(), streams_.end(), takes);
    if (!(*stream)->publish(*frame, device_->layout(frame->sensor))) {
      NODELET_WARN_STREAM_THROTTLE(kThrottlePeriod, "a corrupt frame was skipped");
    }
  }
  if (silence().count() > parameters_.frame_timeout) {
    if (diagnostics_->setState(DeviceState::stalled, "stalled: frames do not come")) {
      NODELET_WARN_STREAM(device_->uri() << " has stalled: no frame for " << parameters_.frame_timeout << " s");
    }
  } else if (frame && diagnostics_->setState(DeviceState::connected, "connected")) {
    NODELET_INFO_STREAM(device_->uri() << " sends frames again");
  }
  return frame.has_value();
}

std::chrono::duration<double> XtionNodelet::silence() const
{
  std::chrono::duration<double> longest{0.0};
  for (const auto& stream : streams_) {
    longest = std::max<std::chrono::duration<double>>(longest, stream->silence(*device_));
  }
  return longest;
}

bool XtionNodelet::goOnAfter(StreamEnd end)
{
  if (end == StreamEnd::disconnected) {
    NODELET_WARN_STREAM(diagnostics_->uri() << " was disconnected; waiting for it");
    diagnostics_->setState(DeviceState::disconnected, "disconnected");
  } else if (end == StreamEnd::ended && !parameters_.playback_loop) {
    NODELET_INFO_STREAM("end of " << diagnostics_->uri());
    diagnostics_->setState(DeviceState::ended, "end of the recording");
    while (pause(kPoll)) {
      diagnostics_->update();
    }
  }
  return pause(std::chrono::milliseconds(0));
}

void XtionNodelet::complain(const std::exception& error)
{
  const bool not_found = dynamic_cast<const DeviceNotFound*>(&error) != nullptr;
  if (!(not_found && diagnostics_->state() == DeviceState::disconnected)) {  // the disconnection was already reported
    const std::string text =
        (not_found ? "waiting for a device: " : "the device cannot be used: ") + std::string(error.what());
    if (text != last_complaint_) {
      NODELET_WARN_STREAM(text);
      last_complaint_ = text;
    }
    diagnostics_->setState(DeviceState::waiting, text);
  }
  diagnostics_->update();
}

bool XtionNodelet::pause(std::chrono::milliseconds time)
{
  std::unique_lock<std::mutex> lock(closing_mutex_);
  return !closing_changed_.wait_for(lock, time, [this] { return closing_; });
}

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::XtionNodelet, nodelet::Nodelet)
