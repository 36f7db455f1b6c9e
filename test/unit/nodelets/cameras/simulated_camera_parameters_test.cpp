#include "nodelets/cameras/simulated_camera_parameters.h"

#include "grasp_affordances/config.h"
#include "simulation/scene_library.h"

#include <gtest/gtest.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <string>
#include <utility>

namespace grasp_affordances
{
namespace
{

using XmlRpc::XmlRpcValue;

/// What the refusal of one parameter says; empty if it is accepted.
std::string refusal(const std::string& name, const XmlRpcValue& value)
{
  XmlRpcValue parameters;
  parameters[name] = value;
  try {
    simulatedCameraParameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(SimulatedCameraParameters, DefaultsAreThoseOfTheYamlFile)
{
  const YAML::Node file = YAML::LoadFile(GRASP_AFFORDANCES_SOURCE_DIR "/config/simulated_camera.yaml");
  const SimulatedCameraParameters defaults;
  EXPECT_EQ(file.size(), 13U);
  EXPECT_EQ(file["scene"].as<std::string>(), defaults.scene);
  EXPECT_EQ(file["background"].as<std::string>(), defaults.background);
  EXPECT_EQ(file["sensor"].as<std::string>(), defaults.sensor);
  EXPECT_EQ(file["seed"].as<std::uint64_t>(), defaults.seed);
  EXPECT_EQ(file["noise_seed"].as<std::uint64_t>(), defaults.noise_seed);
  EXPECT_EQ(file["turn_deg"].as<double>(), defaults.turn_deg);
  EXPECT_EQ(file["rate"].as<double>(), defaults.rate);
  EXPECT_EQ(file["motion"].as<std::string>(), defaults.motion);
  EXPECT_EQ(file["amplitude_deg"].as<double>(), defaults.amplitude_deg);
  EXPECT_EQ(file["period_s"].as<double>(), defaults.period_s);
  EXPECT_EQ(file["frames_ahead"].as<std::uint32_t>(), defaults.frames_ahead);
  EXPECT_EQ(file["world_frame"].as<std::string>(), defaults.world_frame);
  EXPECT_EQ(file["camera"].as<std::string>(), defaults.camera);
}

TEST(SimulatedCameraParameters, EveryOneIsRead)
{
  XmlRpcValue parameters;
  parameters["scene"] = "empty_table";
  parameters["background"] = "open";
  parameters["seed"] = 7;
  parameters["noise_seed"] = 1000;
  parameters["turn_deg"] = -90;
  parameters["rate"] = 15;
  parameters["motion"] = "orbit";
  parameters["amplitude_deg"] = 2.5;
  parameters["period_s"] = 20.0;
  parameters["frames_ahead"] = 60;
  parameters["world_frame"] = "map";
  parameters["camera"] = "xtion";
  const SimulatedCameraParameters read = simulatedCameraParameters(parameters);
  EXPECT_EQ(read.scene, "empty_table");
  EXPECT_EQ(read.background, "open");
  EXPECT_EQ(read.seed, 7U);
  EXPECT_EQ(read.noise_seed, 1000U);
  EXPECT_EQ(read.turn_deg, -90.0);
  EXPECT_EQ(read.rate, 15.0);
  EXPECT_EQ(read.motion, "orbit");
  EXPECT_EQ(read.amplitude_deg, 2.5);
  EXPECT_EQ(read.period_s, 20.0);
  EXPECT_EQ(read.frames_ahead, 60U);
  EXPECT_EQ(read.world_frame, "map");
  EXPECT_EQ(read.camera, "xtion");
}

TEST(SimulatedCameraParameters, RefusalOfAnUnknownSceneNamesTheKnownOnes)
{
  const std::string text = refusal("scene", "tabel");
  EXPECT_NE(text.find("~scene is the string 'tabel'; it must be one of "), std::string::npos) << text;
  for (const NamedScene& scene : sceneLibrary()) {
    EXPECT_NE(text.find(" " + scene.name), std::string::npos) << text;
    EXPECT_EQ(refusal("scene", scene.name), "");
  }
}

TEST(SimulatedCameraParameters, RefusesWhatIsNotAllowed)
{
  EXPECT_EQ(refusal("motion", "shaky"), "parameter ~motion is the string 'shaky'; it must be one of still orbit");
  for (const auto& [name, value] : {std::pair<const char*, XmlRpcValue>{"scene", 3},
                                    {"background", "wall"},
                                    {"seed", -1},
                                    {"noise_seed", -1},
                                    {"turn_deg", 181.0},
                                    {"rate", 0.0},
                                    {"rate", 1e3},
                                    {"motion", true},
                                    {"amplitude_deg", -1.0},
                                    {"period_s", 0.0},
                                    {"frames_ahead", -1},
                                    {"frames_ahead", 0.5},
                                    {"frames_ahead", 1001},
                                    {"world_frame", 1},
                                    {"camera", 0.5},
                                    {"sceen", "table"}}) {
    EXPECT_NE(refusal(name, value).find(std::string("parameter ~") + name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace grasp_affordances
