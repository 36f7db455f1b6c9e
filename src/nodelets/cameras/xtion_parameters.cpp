#include "nodelets/cameras/xtion_parameters.h"

#include "nodelets/parameters/parameter_reader.h"

#include <cstddef>
#include <regex>
#include <stdexcept>
#include <string>

namespace grasp_affordances
{
namespace
{

FrameMode readMode(const std::string& name, const std::string& word, const std::string& alternative)
{
  try {
    return frameModeFromWord(word);
  } catch (const std::invalid_argument& error) {
    throw ParameterError("parameter ~" + name + " is the string '" + word + "'; it must be " + alternative +
                         error.what());
  }
}

/// Checks the URL of a calibration file. It must be safe: camera_info_manager passes the name of the file's folder to a
/// shell command that creates the folder. And set_camera_info overwrites the file.
void checkUrl(const std::string& name, const std::string& url)
{
  static const std::regex kAllowed(R"((file://|package://)([\w./+-]|\$\{NAME\}|\$\{ROS_HOME\})+\.(yaml|yml|ini))");
  constexpr std::size_t kLongest = 1000;  // characters; std::regex needs one nested call for each
  if (!url.empty() && (url.size() > kLongest || !std::regex_match(url, kAllowed))) {
    throw ParameterError(
        "parameter ~" + name + " is the string '" + url +
        "'; it must be empty or file://... or package://..., of at most 1000 letters, digits and any of "
        "_./+-, ${NAME} and ${ROS_HOME}, and end in .yaml, .yml or .ini");
  }
}

XtionParameters xtionParameters(ParameterReader read)
{
  using Real = Range<double>;
  XtionParameters result;
  std::string depth_mode = frameModeWord(result.depth_mode);
  std::string color_mode = "off";
  read("device_id", result.device_id, "a string: empty, '#1', a URI, a serial number or the path of a recording");
  read("depth_mode", depth_mode, "a mode such as 640x480@30");
  read("color_mode", color_mode, "the string 'off' or a mode such as 640x480@30");
  read("depth_registration", result.depth_registration, "");
  read("z_scaling", result.z_scaling, Real{0.5, 1.5}, "", "");
  read("z_offset_mm", result.z_offset_mm, Range<int>{-200, 200}, "mm", "");
  read("time_offset", result.time_offset, Real{-1.0, 1.0}, "s", "");
  read("max_rate", result.max_rate, Real{0.0, 120.0}, "Hz", "");
  read("frame_timeout", result.frame_timeout, Real{0.5, 60.0}, "s", "");
  read("playback_loop", result.playback_loop, "");
  read("camera", result.camera, "what the names of frames begin with");
  read("publish_tf", result.publish_tf, "");
  read("depth_camera_info_url", result.depth_camera_info_url, "the URL of a calibration");
  read("rgb_camera_info_url", result.rgb_camera_info_url, "the URL of a calibration");
  read("diagnostic_period", result.diagnostic_period, Real{0.1, 60.0}, "s", "");
  read.refuseRemaining();
  checkUrl("depth_camera_info_url", result.depth_camera_info_url);
  checkUrl("rgb_camera_info_url", result.rgb_camera_info_url);

  result.depth_mode = readMode("depth_mode", depth_mode, "");
  if (color_mode != "off") {
    result.color_mode = readMode("color_mode", color_mode, "off or ");
  }
  return result;
}

}  // namespace

XtionParameters xtionParameters(const XmlRpc::XmlRpcValue& parameters)
{
  return xtionParameters(ParameterReader(parameters));
}

XtionParameters xtionParameters(const ros::NodeHandle& private_node_handle)
{
  return xtionParameters(ParameterReader(private_node_handle));
}

}  // namespace grasp_affordances
