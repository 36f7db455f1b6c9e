#include "simulation/sensor_model.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// The values of all fields, in the order of visitSensor().
class Values
{
public:
  explicit Values(const SensorModel& model) { visitSensor(model, *this); }

  template <typename T>
  void operator()(const char*, const T& field, const Range<T>&, const char*, const char*)
  {
    values.push_back(static_cast<double>(field));
  }

  template <typename T>
  void operator()(const char*, const T& field, const char*)
  {
    values.push_back(static_cast<double>(field));
  }

  std::vector<double> values;
};

std::string messageOf(const std::string& yaml)
{
  try {
    sensorModelFromYaml(yaml);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

const std::string kFolder = GRASP_AFFORDANCES_SOURCE_DIR "/config/sensors/";

TEST(SensorModel, TheXtionsFileHasTheDefaults)
{
  EXPECT_EQ(Values(sensorModel("xtion")).values, Values(SensorModel()).values);
}

TEST(SensorModel, KnownSensorsAreTheFilesOfTheFolder)
{
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    files.insert(entry.path().stem().string());
  EXPECT_EQ(files, std::set<std::string>(sensorNames().begin(), sensorNames().end()));
  for (const std::string& name : sensorNames()) {
    EXPECT_EQ(Values(sensorModel(name)).values, Values(sensorModelFromFile(kFolder + name + ".yaml")).values) << name;
    EXPECT_EQ(Values(sensorModel(name)).values, Values(sensorModelFromNameOrFile(name)).values) << name;
  }
}

TEST(SensorModel, ErrorsAreOneSentenceThatNamesTheField)
{
  EXPECT_EQ(messageOf("noise: {disparity: -1}"), "noise/disparity: -1 is outside the allowed range [0, 10] px");
  EXPECT_EQ(messageOf("noise: {diparity: 1}"), "noise/diparity: no such parameter (its value: '1')");
  EXPECT_EQ(messageOf("image: {width: wide}"), "image/width: 'wide' is not a whole number");
  EXPECT_EQ(messageOf("image: {width: -1}"), "image/width: '-1' is not a whole number");
  EXPECT_EQ(messageOf("principle: sonar"), "principle: 'sonar' is none of: structured_light, stereo, time_of_flight");
  EXPECT_EQ(messageOf("principle: time_of_flight"), "projector_x: it must be 0 for time of flight");
  EXPECT_EQ(messageOf("projector_x: 0"), "projector_x: it must not be 0 for a sensor that triangulates");
  EXPECT_EQ(messageOf("range: {min: 2, max: 1}"), "range/max: it is not above range/min");
  EXPECT_EQ(messageOf("depth_camera: {width: 640}"), "depth_camera/width: with it height, fx and fy must be given");
  EXPECT_EQ(messageOf("[1, 2]"), "the configuration is no YAML map");
  EXPECT_EQ(messageOf("projector_x: 0.1"), "");
}

TEST(SensorModel, RefusesUnknownNamesAndFiles)
{
  try {
    sensorModel("sonar");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find("there is no sensor 'sonar'; there are xtion, "), 0U) << error.what();
  }
  EXPECT_THROW(sensorModelFromNameOrFile("missing.yaml"), ParameterError);
  EXPECT_THROW(sensorModelFromNameOrFile(".yaml"), std::invalid_argument);
}

TEST(SensorModel, FinestDifferenceIsThatOfTheDepthCamera)
{
  const SensorModel kinect = sensorModel("kinect_v1");
  EXPECT_NEAR(kinect.depthQuantum(1.0), 0.125 / (575.8 * 0.075), 1e-9);  // not of the color camera, whose f is 525
  EXPECT_EQ(kinect.unregistered().width, 640U);
  EXPECT_EQ(kinect.unregistered().intrinsics.fx, 575.8);
  EXPECT_FALSE(kinect.unregistered().registered());
  EXPECT_EQ(sensorModel("kinect_v2").depthQuantum(2.0), 0.001);
}

}  // namespace
}  // namespace grasp_affordances
