#pragma once

#include "openni2/depth_image.h"
#include "openni2/video_mode.h"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>

namespace grasp_affordances
{

/// The parameters of the driver for OpenNI2 cameras. Each member is a private parameter of the same name.
struct XtionParameters
{
  std::string device_id;  ///< empty: the first; #2: the second; a URI or a part of it; a serial number; FILE.oni
  FrameMode depth_mode;   ///< as a word such as 640x480@30
  std::optional<FrameMode> color_mode;  ///< likewise; the word off: no color stream
  bool depth_registration = false;      ///< register the depth image to the color image
  double z_scaling = 1.0;               ///< 0.5 to 1.5, see DepthCorrection
  int z_offset_mm = 0;                  ///< mm, -200 to 200
  double time_offset = -0.033;          ///< s, -1 to 1, added to each stamp: from a frame's arrival to its exposure
  double max_rate = 0.0;                ///< Hz, 0 to 120, highest rate of published frames of a stream; 0: all frames
  double frame_timeout = 1.5;           ///< s, 0.5 to 60; a device that sends no frame for so long has stalled
  bool playback_loop = false;           ///< restart a recording at its end
  std::string camera = "camera";        ///< prefix of the names of the camera's frames
  bool publish_tf = true;               ///< publish the transforms between those frames
  std::string depth_camera_info_url;    ///< URL of a calibration, see camera_info_manager; empty: its default
  std::string rgb_camera_info_url;      ///< likewise
  double diagnostic_period = 1.0;       ///< s, 0.1 to 60, time between messages on /diagnostics

  DepthCorrection correction() const { return {z_scaling, z_offset_mm}; }
};

/// Reads the parameters. An unknown name is an error, because the private namespace belongs to the node alone.
/// @throw ParameterError, with name, value and allowed values, for an unknown name, a wrong type (see ParameterReader)
/// or a value that is not allowed.
XtionParameters xtionParameters(const XmlRpc::XmlRpcValue& parameters);

/// As above, read from the parameter server.
XtionParameters xtionParameters(const ros::NodeHandle& private_node_handle);

}  // namespace grasp_affordances
