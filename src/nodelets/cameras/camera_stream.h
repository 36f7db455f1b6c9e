#pragma once

#include "nodelets/cameras/device_diagnostics.h"
#include "nodelets/roscpp/rate_limiter.h"
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
#include <string>

namespace grasp_affordances
{

/// Where the projection of a camera comes from: a calibration, which camera_info_manager keeps and its service
/// set_camera_info changes, where there is one for pictures of the right size; else the device.
class CameraCalibration
{
public:
  /// @param nh the camera's namespace, as .../depth
  /// @param camera depth or rgb: what the calibration's name begins with; its end is the device's
  CameraCalibration(const ros::NodeHandle& nh, const std::string& camera, const std::string& url);

  /// @param sensor which of the device's it is
  void setDevice(const Device& device, Sensor sensor);

  /// Uncalibrated, K[0] = 0, where nothing is known.
  sensor_msgs::CameraInfoPtr info(const sensor_msgs::Image& image);

private:
  const std::string camera_;
  std::string name_;
  camera_info_manager::CameraInfoManager manager_;
  FieldOfView field_of_view_;
};

/// The topics image_raw and camera_info of one of a device's streams. Not safe to use from several threads.
class CameraStream
{
public:
  using Clock = std::chrono::steady_clock;

  struct Settings
  {
    std::string frame_id;
    double time_offset;  // s, added to stamps
    double max_rate;     // Hz, 0: all frames
    DepthCorrection correction;
  };

  /// @param calibration of the camera whose picture it is
  CameraStream(const ros::NodeHandle& nh, Sensor sensor, const Settings& settings, CameraCalibration& calibration,
               DeviceDiagnostics::Stream& statistics);

  /// Starts the device's stream if somebody listens, and stops it otherwise. @throw DeviceError
  void runIfWanted(Device& device);

  /// Publishes a frame; one that is not intact is counted and skipped. Returns whether it was intact.
  bool publish(const DeviceFrame& frame, const ImageLayout& layout);

  Sensor sensor() const { return sensor_; }

  /// For how long the device owes a frame.
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
