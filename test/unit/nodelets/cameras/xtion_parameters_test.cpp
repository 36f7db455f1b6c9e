#include "nodelets/cameras/xtion_parameters.h"

#include "grasp_affordances/config.h"

#include <gtest/gtest.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <sstream>
#include <string>
#include <utility>

namespace grasp_affordances
{
namespace
{

using XmlRpc::XmlRpcValue;

std::string refusal(const std::string& name, const XmlRpcValue& value)
{
  XmlRpcValue parameters;
  parameters[name] = value;
  try {
    xtionParameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

YAML::Node yamlFile()
{
  return YAML::LoadFile(GRASP_AFFORDANCES_SOURCE_DIR "/config/xtion.yaml");
}

TEST(XtionParameters, DefaultsAreThoseOfTheYamlFile)
{
  const YAML::Node file = yamlFile();
  const XtionParameters defaults;
  EXPECT_EQ(file.size(), 15U);
  EXPECT_EQ(file["device_id"].as<std::string>(), defaults.device_id);
  EXPECT_EQ(file["depth_mode"].as<std::string>(), frameModeWord(defaults.depth_mode));
  EXPECT_EQ(file["color_mode"].as<std::string>(), "off");
  EXPECT_FALSE(defaults.color_mode);
  EXPECT_EQ(file["depth_registration"].as<bool>(), defaults.depth_registration);
  EXPECT_EQ(file["z_scaling"].as<double>(), defaults.z_scaling);
  EXPECT_EQ(file["z_offset_mm"].as<int>(), defaults.z_offset_mm);
  EXPECT_EQ(file["time_offset"].as<double>(), defaults.time_offset);
  EXPECT_EQ(file["max_rate"].as<double>(), defaults.max_rate);
  EXPECT_EQ(file["frame_timeout"].as<double>(), defaults.frame_timeout);
  EXPECT_EQ(file["playback_loop"].as<bool>(), defaults.playback_loop);
  EXPECT_EQ(file["camera"].as<std::string>(), defaults.camera);
  EXPECT_EQ(file["publish_tf"].as<bool>(), defaults.publish_tf);
  EXPECT_EQ(file["depth_camera_info_url"].as<std::string>(), defaults.depth_camera_info_url);
  EXPECT_EQ(file["rgb_camera_info_url"].as<std::string>(), defaults.rgb_camera_info_url);
  EXPECT_EQ(file["diagnostic_period"].as<double>(), defaults.diagnostic_period);
}

TEST(XtionParameters, AreInTheDocumentationWithTheirDefaults)
{
  std::ifstream stream(GRASP_AFFORDANCES_SOURCE_DIR "/docs/cameras.md");
  std::stringstream text;
  text << stream.rdbuf();
  const std::string page = text.str();
  const std::size_t begin = page.find("\n## Asus Xtion\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
  for (const auto& parameter : yamlFile()) {
    const std::string row = "\n| `" + parameter.first.as<std::string>() + "` | " + parameter.second.as<std::string>();
    EXPECT_NE(section.find(row), std::string::npos) << row;
  }
}

TEST(XtionParameters, EveryOneIsRead)
{
  XmlRpcValue parameters;
  parameters["device_id"] = "#2";
  parameters["depth_mode"] = "320x240@60";
  parameters["color_mode"] = "1280x1024@15";
  parameters["depth_registration"] = true;
  parameters["z_scaling"] = 1.02;
  parameters["z_offset_mm"] = -5;
  parameters["time_offset"] = 0.0;
  parameters["max_rate"] = 10;
  parameters["frame_timeout"] = 3.0;
  parameters["playback_loop"] = true;
  parameters["camera"] = "left";
  parameters["publish_tf"] = false;
  parameters["depth_camera_info_url"] = "file:///depth.yaml";
  parameters["rgb_camera_info_url"] = "file:///rgb.yaml";
  parameters["diagnostic_period"] = 0.5;
  const XtionParameters read = xtionParameters(parameters);
  EXPECT_EQ(read.device_id, "#2");
  EXPECT_EQ(frameModeWord(read.depth_mode), "320x240@60");
  ASSERT_TRUE(read.color_mode);
  EXPECT_EQ(frameModeWord(*read.color_mode), "1280x1024@15");
  EXPECT_TRUE(read.depth_registration);
  EXPECT_EQ(read.correction().z_scaling, 1.02);
  EXPECT_EQ(read.correction().z_offset_mm, -5);
  EXPECT_EQ(read.time_offset, 0.0);
  EXPECT_EQ(read.max_rate, 10.0);
  EXPECT_EQ(read.frame_timeout, 3.0);
  EXPECT_TRUE(read.playback_loop);
  EXPECT_EQ(read.camera, "left");
  EXPECT_FALSE(read.publish_tf);
  EXPECT_EQ(read.depth_camera_info_url, "file:///depth.yaml");
  EXPECT_EQ(read.rgb_camera_info_url, "file:///rgb.yaml");
  EXPECT_EQ(read.diagnostic_period, 0.5);
}

TEST(XtionParameters, RefusalsSayWhatAModeIs)
{
  EXPECT_EQ(refusal("depth_mode", "VGA"),
            "parameter ~depth_mode is the string 'VGA'; it must be a mode such as 640x480@30");
  EXPECT_EQ(refusal("color_mode", "on"),
            "parameter ~color_mode is the string 'on'; it must be off or a mode such as 640x480@30");
  // What YAML makes of the word without quotes.
  EXPECT_EQ(refusal("color_mode", false),
            "parameter ~color_mode is false; it must be the string 'off' or a mode such as 640x480@30");
}

/// camera_info_manager has a shell make the folder of such a file.
TEST(XtionParameters, UrlsOfCalibrationsAreNothingButPaths)
{
  for (const char* name : {"depth_camera_info_url", "rgb_camera_info_url"}) {
    for (const char* url : {"", "file:///home/me/.ros/depth-1.yaml", "package://my_robot/calibration/rgb.yml",
                            "file://${ROS_HOME}/camera_info/${NAME}.yaml", "file:///${NAME}.ini"}) {
      EXPECT_EQ(refusal(name, url), "") << url;
    }
    EXPECT_NE(refusal(name, ("file:///" + std::string(1000000, 'a') + ".yaml").c_str()), "");
    for (const char* url :
         {"file:///tmp/x;touch pwned/depth.yaml", "file:///tmp/$(touch pwned)/depth.yaml",
          "file:///tmp/`id`/depth.yaml", "file:///tmp/a b/depth.yaml", "file:///tmp/x|y/depth.yaml",
          "file:///tmp/x&y/depth.yaml", "file:///tmp/x\ny/depth.yaml", "file:///tmp/${HOME}/depth.yaml",
          "file:///home/me/.bashrc", "/tmp/depth.yaml", "http://example.org/depth.yaml", "file:///tmp/depth.yaml\n"}) {
      EXPECT_NE(refusal(name, url).find(std::string("parameter ~") + name + " is the string"), std::string::npos)
          << url;
    }
  }
}

TEST(XtionParameters, RefusesWhatIsNotAllowed)
{
  for (const auto& [name, value] : {std::pair<const char*, XmlRpcValue>{"device_id", 1},
                                    {"depth_mode", "off"},
                                    {"depth_registration", 1},
                                    {"z_scaling", 0.0},
                                    {"z_offset_mm", 1000},
                                    {"z_offset_mm", 0.5},
                                    {"time_offset", -2.0},
                                    {"max_rate", -1.0},
                                    {"frame_timeout", 0.0},
                                    {"playback_loop", "yes"},
                                    {"camera", 0},
                                    {"publish_tf", 0.5},
                                    {"depth_camera_info_url", true},
                                    {"rgb_camera_info_url", true},
                                    {"diagnostic_period", 0.0},
                                    {"mirror", false}}) {
    EXPECT_NE(refusal(name, value).find(std::string("parameter ~") + name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace grasp_affordances
