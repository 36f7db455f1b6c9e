#pragma once

#include "openni2/depth_image.h"
#include "openni2/video_mode.h"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>

namespace grasp_affordances
{

/// Everything that the driver of an OpenNI2 camera is told by private parameters of these names.
struct XtionParameters
{
  std::string device_id;  ///< empty: any; #2: the second; a URI, or a part of one; a serial number; FILE.oni
  FrameMode depth_mode;   ///< words such as 640x480@30
  std::optional<FrameMode> color_mode;  ///< likewise; the word off: no color
  bool depth_registration = false;      ///< depth as the color camera would see it
  double z_scaling = 1.0;               ///< 0.5 to 1.5, see DepthCorrection
  int z_offset_mm = 0;                  ///< mm, -200 to 200
  double time_offset = -0.033;          ///< s, -1 to 1, added to stamps: from the frame's arrival to its exposure
  double max_rate = 0.0;                ///< Hz, 0 to 120, of what is published of a stream; 0: all frames
  double frame_timeout = 1.5;           ///< s, 0.5 to 60, without a frame, after which a device has stalled
  bool playback_loop = false;           ///< a recording begins again at its end
  std::string camera = "camera";        ///< what the names of the camera's frames begin with
  bool publish_tf = true;               ///< the transforms between those frames
  std::string depth_camera_info_url;    ///< of a calibration, see camera_info_manager; empty: its default place
  std::string rgb_camera_info_url;      ///< likewise
  double diagnostic_period = 1.0;       ///< s, 0.1 to 60, between messages on /diagnostics

  DepthCorrection correction() const { return {z_scaling, z_offset_mm}; }
};

/// Every name must be known: the private namespace belongs to the node.
/// @throw ParameterError with name, value and allowed values for an unknown name, a wrong type (see ParameterReader) or
/// a value that is not allowed.
XtionParameters xtionParameters(const XmlRpc::XmlRpcValue& parameters);

/// As above, from the parameter server.
XtionParameters xtionParameters(const ros::NodeHandle& private_node_handle);

}  // namespace grasp_affordances
