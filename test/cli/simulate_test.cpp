#include "cli/command_line_test.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <png.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

class SimulateTest : public test::CommandLineTest
{
protected:
  /// @return exit status
  int simulate(const std::string& arguments) const { return run("exec " SIMULATE " " + arguments); }
};

std::vector<std::uint16_t> readDepth(const std::string& file)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0)
    return {};
  image.format = PNG_FORMAT_LINEAR_Y;
  std::vector<std::uint16_t> pixels(std::size_t{image.width} * image.height);
  png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
  return pixels;
}

TEST_F(SimulateTest, CloudDepthImageAndObjectListAgree)
{
  ASSERT_EQ(simulate("--scene table --seed 2 --out a.pcd --depth a.png --objects a.json"), 0) << content("stderr");
  pcl::PointCloud<pcl::PointXYZL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path("a.pcd"), cloud), 0);
  const std::vector<std::uint16_t> depth = readDepth(path("a.png"));
  const nlohmann::json objects = nlohmann::json::parse(content("a.json"));

  ASSERT_EQ(depth.size(), cloud.size());
  ASSERT_EQ(objects["camera"]["width"], cloud.width);
  ASSERT_EQ(objects["camera"]["height"], cloud.height);
  std::map<std::uint32_t, std::size_t> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(depth[i], std::isnan(cloud[i].z) ? 0 : std::lround(1000.0 * cloud[i].z)) << "pixel " << i;
    ++points[cloud[i].label];
  }
  EXPECT_EQ(objects["scene"], "table");
  EXPECT_EQ(objects["seed"], 2);
  EXPECT_EQ(objects["definition"]["capture_radius"], 0.026);
  ASSERT_EQ(objects["affordances"].size(), 3U);
  for (const nlohmann::json& affordance : objects["affordances"]) {
    const std::string name = affordance["object"];
    EXPECT_EQ(affordance["visible_points"], points[affordance["label"]]);
    EXPECT_GE(affordance["visible_points"], 100);
    EXPECT_LT(affordance["radius"], 0.026);
    EXPECT_GE(affordance["length"], 0.03);
    EXPECT_GE(affordance["axis"].size(), 8U);
    EXPECT_LT(affordance["occluded_share"], 0.2);
    EXPECT_NE(content("stdout").find("  " + name + ": radius "), std::string::npos);
  }
}

TEST_F(SimulateTest, SensorIsANameOrAFile)
{
  ASSERT_EQ(simulate("--scene empty_table --sensor kinect_v2 --out a.pcd --objects a.json"), 0) << content("stderr");
  pcl::PointCloud<pcl::PointXYZL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path("a.pcd"), cloud), 0);
  EXPECT_EQ(cloud.width, 512U);
  EXPECT_EQ(cloud.height, 424U);
  EXPECT_EQ(nlohmann::json::parse(content("a.json"))["camera"]["width"], 512);

  std::ofstream(path("mine.yaml")) << "range: {min: 0.1, max: 0.2}\n";
  ASSERT_EQ(simulate("--scene empty_table --sensor mine.yaml --out b.pcd"), 0) << content("stderr");
  EXPECT_NE(content("stdout").find(": 0 of 307200 points measured"), std::string::npos) << content("stdout");

  EXPECT_EQ(simulate("--scene empty_table --sensor sonar --out b.pcd"), 2);
  EXPECT_EQ(content("stderr").find("simulate: --sensor: there is no sensor 'sonar'"), 0U) << content("stderr");
  std::ofstream(path("bad.yaml")) << "noise: {disparity: many}\n";
  EXPECT_EQ(simulate("--scene empty_table --sensor bad.yaml --out b.pcd"), 2);
  EXPECT_EQ(content("stderr"), "simulate: --sensor: bad.yaml: noise/disparity: 'many' is not a number\n");
}

TEST_F(SimulateTest, TurnedCameraSeesTheSameSceneAndItsPoseIsTheViewpoint)
{
  ASSERT_EQ(simulate("--scene table --out a.pcd --objects a.json"), 0) << content("stderr");
  ASSERT_EQ(simulate("--scene table --turn 90 --noise-seed 5 --out b.pcd --objects b.json"), 0) << content("stderr");
  const nlohmann::json a = nlohmann::json::parse(content("a.json")), b = nlohmann::json::parse(content("b.json"));
  ASSERT_EQ(a["affordances"].size(), b["affordances"].size());
  for (std::size_t i = 0; i < a["affordances"].size(); ++i)
    EXPECT_EQ(a["affordances"][i]["axis"], b["affordances"][i]["axis"]);
  EXPECT_NE(a["camera"]["position"], b["camera"]["position"]);

  pcl::PointCloud<pcl::PointXYZL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path("b.pcd"), cloud), 0);
  const nlohmann::json& camera = b["camera"];
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(cloud.sensor_origin_[i], camera["position"][i].get<double>(), 1e-5);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(cloud.sensor_orientation_.coeffs()[i], camera["orientation"][i].get<double>(), 1e-5);

  // In the scene's frame the table's top is at z = 0, from wherever it is seen.
  const Eigen::Isometry3f T_scene_camera =
      Eigen::Translation3f(cloud.sensor_origin_.head<3>()) * cloud.sensor_orientation_;
  std::size_t measured = 0, on_table = 0;
  for (const pcl::PointXYZL& point : cloud) {
    measured += std::isnan(point.z) ? 0 : 1;
    on_table += std::abs((T_scene_camera * point.getVector3fMap()).z()) < 0.01F ? 1 : 0;
  }
  EXPECT_GT(on_table, measured / 2);
}

TEST_F(SimulateTest, LabelsAreThoseOfTheGivenHand)
{
  ASSERT_EQ(simulate("--scene table --objects a.json --capture-radius 0.005"), 0);
  EXPECT_TRUE(nlohmann::json::parse(content("a.json"))["affordances"].empty());
}

TEST_F(SimulateTest, SameArgumentsGiveTheSameBytes)
{
  ASSERT_EQ(simulate("--scene table --out a.pcd --depth a.png --objects a.json"), 0);
  ASSERT_EQ(simulate("--scene table --out b.pcd --depth b.png --objects b.json"), 0);
  for (const std::string type : {"pcd", "png", "json"})
    EXPECT_EQ(content("a." + type), content("b." + type));
}

TEST_F(SimulateTest, BackgroundTiltAndDistanceChangeWhatIsSeenAndNotWhatIsThere)
{
  ASSERT_EQ(simulate("--scene kitchen1 --out a.pcd --objects a.json"), 0) << content("stderr");
  ASSERT_EQ(simulate("--scene kitchen1 --background walls --out b.pcd --objects b.json"), 0) << content("stderr");
  EXPECT_EQ(content("a.pcd"), content("b.pcd"));
  const nlohmann::json a = nlohmann::json::parse(content("a.json"));
  for (const std::string options : {"--background open", "--tilt 60 --distance 1.2"}) {
    ASSERT_EQ(simulate("--scene kitchen1 --out b.pcd --objects b.json " + options), 0) << content("stderr");
    EXPECT_NE(content("a.pcd"), content("b.pcd"));
    const nlohmann::json b = nlohmann::json::parse(content("b.json"));
    EXPECT_EQ(a["camera"]["position"] == b["camera"]["position"], options == "--background open");
  }
  EXPECT_EQ(simulate("--scene shadow --tilt 10 --out b.pcd"), 1);
  EXPECT_NE(content("stderr").find("looks along the vertical"), std::string::npos) << content("stderr");
}

TEST_F(SimulateTest, RefusesBadUsage)
{
  for (const char* arguments :
       {"", "--scene table", "--scene tables --out a.pcd", "--scene table --out a.pcd --seed -1",
        "--scene table --out a.pcd --capture-radius 0", "--scene table --out a.pcd --turn 181",
        "--scene table --out a.pcd --turn nan", "--scene table --out a.pcd --capture-radius nan",
        "--scene table --list", "--scene table --out a.pcd --background wall", "--scene table --out a.pcd --tilt 76",
        "--scene table --out a.pcd --distance 0.3"}) {
    EXPECT_EQ(simulate(arguments), 2) << arguments;
    EXPECT_FALSE(content("stderr").empty()) << arguments;
  }
}

TEST_F(SimulateTest, SaysWhenStdoutIsFull)
{
  for (const char* arguments : {"--list", "--scene empty_table --out cloud.pcd"}) {
    EXPECT_EQ(run("(" SIMULATE " " + std::string(arguments) + " > /dev/full)"), 1);
    EXPECT_NE(content("stderr").find("cannot write to stdout"), std::string::npos);
  }
}

TEST_F(SimulateTest, NamesTheFileThatCannotBeWritten)
{
  for (const std::string option : {"--out", "--depth", "--objects"}) {
    EXPECT_EQ(simulate("--scene empty_table " + option + " missing/file"), 1);
    EXPECT_EQ(content("stderr").find("simulate: cannot write missing/file: "), 0U) << content("stderr");
  }
}

}  // namespace
}  // namespace grasp_affordances
