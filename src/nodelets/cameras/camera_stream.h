#pragma once

#include "nodelets/cameras/device_diagnostics.h"
#include "nodelets/roscpp/rate_limiter.h"
#include "nodelets/roscpp/service_thread.h"
#include "openni2/depth_image.h"
#include "openni2/device.h"
#include "openni2/device_clock.h"
#include "openni2/field_of_view.h"

#include <camera_info_manager/camera_info_manager.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace grasp_affordances
{

/// Source of a camera's intrinsics. If there is a calibration for images of the right size, that is used;
/// camera_info_manager stores it, and its service set_camera_info changes it. Otherwise the intrinsics follow from the
/// field of view that the device reports.
class CameraCalibration
{
public:
  /// @param nh the camera's namespace, for example .../depth
  /// @param camera depth or rgb. The calibration's name is this word and the device's serial number, or else its URI.
  /// @param url of the calibration file; empty: the default of camera_info_manager
  CameraCalibration(const ros::NodeHandle& nh, const std::string& camera, const std::string& url);

  ~CameraCalibration();

  /// Selects the calibration of a device. @param sensor the device's sensor that this camera belongs to
  void setDevice(const Device& device, Sensor sensor);

  /// The CameraInfo for an image. It is uncalibrated (K[0] = 0) if neither a calibration nor a field of view is known.
  sensor_msgs::CameraInfoPtr info(const sensor_msgs::Image& image);

private:
  const std::string camera_;
  std::string name_;
  FieldOfView field_of_view_;
  ServiceThread thread_;
  std::shared_ptr<camera_info_manager::CameraInfoManager> manager_;
};

/// Publishes one stream of a device on the topics image_raw and camera_info. Not safe to use from several threads.
class CameraStream
{
public:
  using Clock = std::chrono::steady_clock;

  struct Settings
  {
    std::string frame_id;
    double time_offset;  // s, added to each stamp
    double max_rate;     // Hz, 0: all frames
    DepthCorrection correction;
  };

  /// @param calibration of the camera whose image the stream shows
  CameraStream(const ros::NodeHandle& nh, Sensor sensor, const Settings& settings, CameraCalibration& calibration,
               DeviceDiagnostics::Stream& statistics);

  /// Starts the device's stream if a topic has a subscriber, and stops it otherwise.
  /// @throw DeviceError if the stream does not start.
  void runIfWanted(Device& device);

  /// Publishes a frame. A frame that is not intact is counted and not published. Returns whether it was intact.
  bool publish(const DeviceFrame& frame, const ImageLayout& layout);

  Sensor sensor() const { return sensor_; }

  /// Time since the last frame of a running stream; 0 if the stream does not run.
  Clock::duration silence(const Device& device) const;

private:
  ros::Time stamp(std::uint64_t device_us);

  const Sensor sensor_;
  const Settings settings_;
  CameraCalibration& calibration_;
  DeviceDiagnostics::Stream& statistics_;
  ros::Publisher image_;
  ros::Publisher camera_info_;
  DeviceClock clock_;
  RateLimiter limiter_;
  Clock::time_point last_frame_;
};

}  // namespace grasp_affordances
