#include "nodelets/cameras/camera_stream.h"

#include "grasp_affordances/cloud.h"
#include "nodelets/cameras/camera_messages.h"

#include <ros/console.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace grasp_affordances
{
namespace
{

/// The name of a calibration. It may have letters, digits and underscores only.
std::string calibrationName(const std::string& camera, const Device& device)
{
  std::string name = camera + "_" + (device.serial().empty() ? device.uri() : device.serial());
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

sensor_msgs::ImagePtr imageMessage(const DeviceFrame& frame, const ImageLayout& layout,
                                   const DepthCorrection& correction)
{
  const bool is_depth = frame.sensor == Sensor::depth;
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->width = layout.width;
  message->height = layout.height;
  message->encoding = is_depth ? sensor_msgs::image_encodings::TYPE_16UC1 : sensor_msgs::image_encodings::RGB8;
  message->step = message->width * (is_depth ? sizeof(std::uint16_t) : 3);
  message->data.resize(std::size_t{message->step} * message->height);
  if (is_depth) {
    depthMillimetres(frame.image, layout, correction, reinterpret_cast<std::uint16_t*>(message->data.data()));
  } else {
    rgbBytes(frame.image, layout, message->data.data());
  }
  return message;
}

}  // namespace

CameraCalibration::CameraCalibration(const ros::NodeHandle& nh, const std::string& camera, const std::string& url)
    : camera_(camera),
      manager_(std::make_shared<camera_info_manager::CameraInfoManager>(thread_.nodeHandle(nh), camera, url))
{
  thread_.start();
}

CameraCalibration::~CameraCalibration()
{
  thread_.stop();
  thread_.end(std::move(manager_));
}

void CameraCalibration::setDevice(const Device& device, Sensor sensor)
{
  const std::string name = calibrationName(camera_, device);
  if (name != name_) {  // otherwise the manager already has this calibration, and need not read its file again
    manager_->setCameraName(name);
    name_ = name;
  }
  field_of_view_ = device.fieldOfView(sensor);
}

sensor_msgs::CameraInfoPtr CameraCalibration::info(const sensor_msgs::Image& image)
{
  if (manager_->isCalibrated()) {
    auto calibrated = boost::make_shared<sensor_msgs::CameraInfo>(manager_->getCameraInfo());
    if (calibrated->width == image.width && calibrated->height == image.height) {
      calibrated->header = image.header;
      return calibrated;
    }
    ROS_WARN_STREAM_ONCE("the calibration " << camera_ << " is for images of " << calibrated->width << "x"
                                            << calibrated->height << " and is not used");
  }
  const std::optional<PinholeIntrinsics> intrinsics = pinholeIntrinsics(field_of_view_, image.width, image.height);
  if (!intrinsics) {
    ROS_WARN_STREAM_ONCE("the device reports no field of view: without a calibration its camera_info is empty");
  }
  return cameraInfoMessage(intrinsics.value_or(PinholeIntrinsics()), image.width, image.height, image.header);
}

CameraStream::CameraStream(const ros::NodeHandle& nh, Sensor sensor, const Settings& settings,
                           CameraCalibration& calibration, DeviceDiagnostics::Stream& statistics)
    : sensor_(sensor),
      settings_(settings),
      calibration_(calibration),
      statistics_(statistics),
      limiter_(settings.max_rate)
{
  ros::NodeHandle camera_nh(nh);
  image_ = camera_nh.advertise<sensor_msgs::Image>("image_raw", 1);
  camera_info_ = camera_nh.advertise<sensor_msgs::CameraInfo>("camera_info", 1);
}

void CameraStream::runIfWanted(Device& device)
{
  const bool wanted = image_.getNumSubscribers() > 0 || camera_info_.getNumSubscribers() > 0;
  if (wanted && !device.runs(sensor_)) {
    last_frame_ = Clock::now();
    clock_.restart();
  }
  device.run(sensor_, wanted);
}

CameraStream::Clock::duration CameraStream::silence(const Device& device) const
{
  return device.runs(sensor_) ? Clock::now() - last_frame_ : Clock::duration::zero();
}

bool CameraStream::publish(const DeviceFrame& frame, const ImageLayout& layout)
{
  last_frame_ = Clock::now();
  if (!frame.intact) {
    ++statistics_.corrupt;
    return false;
  }
  ++statistics_.frames;
  const ros::Time time = stamp(frame.device_us);
  if (limiter_.passes(static_cast<std::int64_t>(time.toNSec()))) {
    const sensor_msgs::ImagePtr image = imageMessage(frame, layout, settings_.correction);
    image->header.stamp = time;
    image->header.frame_id = settings_.frame_id;
    camera_info_.publish(calibration_.info(*image));
    image_.publish(image);
  }
  return true;
}

ros::Time CameraStream::stamp(std::uint64_t device_us)
{
  const auto arrival = static_cast<std::int64_t>(ros::Time::now().toNSec());
  const auto offset = static_cast<std::int64_t>(1e9 * settings_.time_offset);
  ros::Time time;
  time.fromNSec(std::max<std::int64_t>(0, clock_.hostTime(device_us, arrival) + offset));
  return time;
}

}  // namespace grasp_affordances
