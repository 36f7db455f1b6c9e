#include "nodelets/parameters/parameters_ros.h"

#include <gtest/gtest.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace grasp_affordances
{
namespace
{

using XmlRpc::XmlRpcValue;

/// What the refusal of one parameter says; empty if it is accepted.
std::string refusal(const std::string& group, const std::string& name, const XmlRpcValue& value)
{
  XmlRpcValue parameters;
  if (group.empty()) {
    parameters[name] = value;
  } else {
    parameters[group][name] = value;
  }
  try {
    nodeParameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(NodeParameters, DefaultsAreThoseOfTheDefaultPreset)
{
  XmlRpcValue parameters;
  parameters["lazy"] = false;
  const NodeParameters read = nodeParameters(parameters);
  EXPECT_EQ(read.config.preset, "localizer");
  EXPECT_EQ(read.config.hand.capture_radius, HandGeometry().capture_radius);
  EXPECT_FALSE(read.lazy);
  EXPECT_TRUE(NodeParameters().lazy);
}

TEST(NodeParameters, Frames)
{
  EXPECT_EQ(NodeParameters().workspace_frame, "");
  EXPECT_EQ(NodeParameters().target_frame, "");
  EXPECT_EQ(NodeParameters().fixed_frame, "");
  EXPECT_EQ(NodeParameters().approach_frame, "");
  EXPECT_EQ(NodeParameters().sensor_frame, "");
  XmlRpcValue parameters;
  parameters["workspace_frame"] = "table";
  parameters["target_frame"] = "/base";
  parameters["fixed_frame"] = "/odom";
  parameters["approach_frame"] = "base_link";
  parameters["sensor_frame"] = "/camera";
  parameters["transform_timeout"] = 1;
  const NodeParameters read = nodeParameters(parameters);
  EXPECT_EQ(read.workspace_frame, "table");
  EXPECT_EQ(read.target_frame, "base");
  EXPECT_EQ(read.fixed_frame, "odom");
  EXPECT_EQ(read.approach_frame, "base_link");
  EXPECT_EQ(read.sensor_frame, "camera");
  EXPECT_EQ(read.transform_timeout, 1.0);
  EXPECT_TRUE(contains(refusal("", "target_frame", 3), "the name of a frame"));
  EXPECT_TRUE(contains(refusal("", "transform_timeout", -0.1), "[0, 10] s"));
}

TEST(NodeParameters, OnDemand)
{
  EXPECT_FALSE(NodeParameters().on_demand);
  EXPECT_EQ(NodeParameters().max_rate, 0.0);
  XmlRpcValue parameters;
  parameters["on_demand"] = true;
  parameters["max_rate"] = 5;
  const NodeParameters read = nodeParameters(parameters);
  EXPECT_TRUE(read.on_demand);
  EXPECT_EQ(read.max_rate, 5.0);
  EXPECT_TRUE(contains(refusal("", "on_demand", 1), "true or false"));
  EXPECT_TRUE(contains(refusal("", "max_rate", -1.0), "[0, 120] Hz"));
}

TEST(NodeParameters, HandlesHaveALongestAge)
{
  EXPECT_EQ(longestAge(NodeParameters()), 5.0);
  XmlRpcValue parameters;
  parameters["max_age"] = 2.0;
  EXPECT_EQ(longestAge(nodeParameters(parameters)), 2.0);
  parameters["max_rate"] = 10.0;
  EXPECT_EQ(longestAge(nodeParameters(parameters)), 2.0);
  parameters["max_rate"] = 0.1;
  EXPECT_EQ(longestAge(nodeParameters(parameters)), 20.0) << "a cloud every 10 s is what was asked for";
  parameters["max_age"] = 0.0;
  EXPECT_EQ(longestAge(nodeParameters(parameters)), 0.0) << "no limit";
  parameters["max_age"] = 2.0;
  parameters["on_demand"] = true;
  EXPECT_EQ(longestAge(nodeParameters(parameters)), 0.0) << "the cloud was asked for";
  EXPECT_TRUE(contains(refusal("", "max_age", -1.0), "[0, 3600] s"));
}

TEST(NodeParameters, PassOverWhatReconfigurationHasLeft)
{
  EXPECT_EQ(refusal("reconfigure", "hand_capture_radius", 0.03), "");
  EXPECT_TRUE(contains(refusal("reconfigur", "hand_capture_radius", 0.03), "unknown name"));
  EXPECT_TRUE(contains(refusal("reconfigured", "hand_capture_radius", 0.03), "unknown name"));
  EXPECT_TRUE(contains(refusal("", "reconfigure", 0.03), "unknown name"));
}

TEST(MultiCameraParameters, AreThoseOfANodeAndItsCameras)
{
  XmlRpcValue parameters;
  parameters["target_frame"] = "table";
  EXPECT_EQ(multiCameraParameters(parameters).views, MultiCameraParameters().views);
  parameters["views"] = 3;
  parameters["sync_slop"] = 0.01;
  parameters["threads"] = 1;
  const MultiCameraParameters read = multiCameraParameters(parameters);
  EXPECT_EQ(read.views, 3U);
  EXPECT_EQ(read.sync_slop, 0.01);
  EXPECT_EQ(read.node.target_frame, "table");
  EXPECT_EQ(read.node.config.threads, 1);
}

TEST(MultiCameraParameters, AreRefused)
{
  XmlRpcValue parameters;
  const auto refusal = [&] {
    try {
      multiCameraParameters(parameters);
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  parameters["views"] = 2;
  EXPECT_TRUE(contains(refusal(), "~target_frame is not given"));
  parameters["target_frame"] = "table";
  EXPECT_EQ(refusal(), "");
  for (const int views : {1, 9}) {
    parameters["views"] = views;
    EXPECT_TRUE(contains(refusal(), "an integer in [2, 8]")) << views;
  }
  parameters["views"] = 2;  // cppcheck-suppress redundantAssignment; refusal() reads it
  XmlRpcValue with_sensor = parameters;
  with_sensor["sensor_frame"] = "camera";
  EXPECT_THROW(multiCameraParameters(with_sensor), ParameterError) << "each camera has a place of its own";
  parameters["slop"] = 0.1;
  EXPECT_TRUE(contains(refusal(), "unknown name"));
}

TEST(MultiCameraParameters, YamlFileHoldsTheDefaults)
{
  const YAML::Node yaml = YAML::LoadFile(std::string(GRASP_AFFORDANCES_SOURCE_DIR) + "/config/multi_camera.yaml");
  EXPECT_EQ(yaml.size(), 2U);
  EXPECT_EQ(yaml["views"].as<std::uint32_t>(), MultiCameraParameters().views);
  EXPECT_EQ(yaml["sync_slop"].as<double>(), MultiCameraParameters().sync_slop);
}

TEST(NodeParameters, EveryKindOfValueOverrulesThePreset)
{
  XmlRpcValue parameters;
  parameters["preset"] = "paper";
  parameters["threads"] = 3;
  parameters["hand"]["capture_radius"] = 0.048;
  parameters["sampling"]["samples"] = 123;
  parameters["sampling"]["seed"] = 42;
  parameters["neighborhood"]["kind"] = "knn";
  parameters["occlusion"]["filter"] = false;
  parameters["estimation"]["estimator"] = "pca";
  const Config config = nodeParameters(parameters).config;
  EXPECT_EQ(config.preset, "paper");
  EXPECT_EQ(config.threads, 3);
  EXPECT_EQ(config.hand.capture_radius, 0.048);
  EXPECT_EQ(config.sampling.samples, 123);
  EXPECT_EQ(config.sampling.seed, 42U);
  EXPECT_EQ(config.neighborhood.kind, NeighborhoodKind::knn);
  EXPECT_FALSE(config.occlusion.filter);
  EXPECT_EQ(config.estimation.estimator, Estimator::pca);
  EXPECT_EQ(config.shell.min_length, presetConfig("paper").shell.min_length);
}

TEST(NodeParameters, AnIntegerIsFineForARealNumberButNotTheOtherWayRound)
{
  EXPECT_EQ(refusal("shell", "min_observed_free", 1), "");
  const std::string text = refusal("sampling", "samples", 500.0);
  EXPECT_TRUE(contains(text, "~sampling/samples")) << text;
  EXPECT_TRUE(contains(text, "500")) << text;
  EXPECT_TRUE(contains(text, "an integer in [1, 1000000]")) << text;
}

TEST(NodeParameters, ASeedBeyond32BitsIsAWholeRealNumber)
{
  XmlRpcValue parameters;
  parameters["sampling"]["seed"] = 9007199254740991.0;
  EXPECT_EQ(nodeParameters(parameters).config.sampling.seed, 9007199254740991U);
  EXPECT_TRUE(contains(refusal("sampling", "seed", 1.5), "an integer"));
  EXPECT_TRUE(contains(refusal("sampling", "seed", 9007199254740992.0), "[0, 9007199254740991]"));
}

TEST(NodeParameters, RefusesValuesOutsideTheirRangeWithNameValueAndRange)
{
  for (const XmlRpcValue& value : {XmlRpcValue(0.7), XmlRpcValue(-1), XmlRpcValue(std::nan(""))}) {
    const std::string text = refusal("hand", "capture_radius", value);
    EXPECT_TRUE(contains(text, "~hand/capture_radius")) << text;
    EXPECT_TRUE(contains(text, "[0.002, 0.5] m")) << text;
  }
  EXPECT_TRUE(contains(refusal("hand", "capture_radius", 0.7), "0.7"));
  EXPECT_TRUE(contains(refusal("sampling", "seed", -1), "-1"));
}

TEST(NodeParameters, RefusesValuesOfAnotherType)
{
  EXPECT_TRUE(contains(refusal("hand", "capture_radius", "wide"), "'wide'"));
  EXPECT_TRUE(contains(refusal("hand", "capture_radius", true), "true"));
  EXPECT_TRUE(contains(refusal("occlusion", "filter", 1), "true or false"));
  EXPECT_TRUE(contains(refusal("", "lazy", "yes"), "~lazy"));
  EXPECT_TRUE(contains(refusal("neighborhood", "kind", 3), "radius knn"));
  EXPECT_TRUE(contains(refusal("neighborhood", "kind", "cube"), "cube"));
  EXPECT_TRUE(contains(refusal("", "preset", "papyrus"), "papyrus"));
}

TEST(NodeParameters, RefusesUnknownNames)
{
  EXPECT_TRUE(contains(refusal("hand", "radius", 0.03), "~hand/radius (the real number 0.03)"));
  EXPECT_TRUE(contains(refusal("hnad", "capture_radius", 0.03), "~hnad/capture_radius"));
  EXPECT_TRUE(contains(refusal("", "hand", 0.03), "~hand"));
  EXPECT_TRUE(contains(refusal("", "sample", 3), "~sample"));
  EXPECT_TRUE(contains(refusal("threads", "count", 3), "~threads/count"));
}

}  // namespace
}  // namespace grasp_affordances
