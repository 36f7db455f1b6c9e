#include "cli/localize_calls.h"

#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

/// Clouds without rows, whose sensor is not at the origin of their frame.
class LocalizeSensor : public LocalizeTest
{
protected:
  static constexpr float kOpposite = 1.625F;  // m, along the camera's z: the origin is on the other side of the table
  const std::string kSensor = "0,0,-1.625";

  static pcl::PointCloud<pcl::PointXYZ> tableFromOpposite()
  {
    pcl::PointCloud<pcl::PointXYZ> points = unorganized(table());
    for (pcl::PointXYZ& point : points) {
      point.z -= kOpposite;
    }
    return points;
  }

  Json json(const std::string& arguments, std::size_t warnings) const
  {
    const Call call = localize("--json --samples 2000 " + arguments);
    EXPECT_EQ(call.status, 0) << arguments;
    EXPECT_EQ(lines(call.err).size(), warnings) << arguments << "\n" << call.err;
    return call.json().at(0);
  }
};

void expectSameShells(const Json& a, const Json& b)
{
  EXPECT_EQ(a["counts"], b["counts"]);
  EXPECT_EQ(a["shells"], b["shells"]);
  EXPECT_EQ(a["handles"], b["handles"]);
}

TEST_F(LocalizeSensor, unknownIsToldAndDecidesNothing)
{
  write("own.pcd", unorganized(table()));
  write("base.pcd", tableFromOpposite());
  const std::size_t handles = json("--viewpoint 0,0,0 own.pcd", 1)["handles"].size();
  ASSERT_GE(handles, 3U);
  const Call call = localize("--json --samples 2000 base.pcd");
  ASSERT_EQ(lines(call.err).size(), 2U) << call.err;
  EXPECT_EQ(lines(call.err)[1].rfind("base.pcd: the place of the sensor is not known", 0), 0U) << call.err;
  EXPECT_NE(call.err.find("--viewpoint x,y,z"), std::string::npos) << call.err;
  const Json result = call.json().at(0);
  EXPECT_EQ(result["counts"]["concave"], 0);
  EXPECT_GE(result["handles"].size(), handles);
  ASSERT_FALSE(result["shells"].empty());
  for (const Json& shell : result["shells"]) {
    EXPECT_TRUE(shell["normal"].is_null()) << shell;
  }
  std::size_t hand_poses = 0;
  for (const Json& handle : result["handles"]) {
    EXPECT_TRUE(handle["normal"].is_null()) << handle;
    hand_poses += handle["hand_poses"].size();
    for (const Json& hand : handle["hand_poses"]) {
      double squared = 0.0;
      for (const Json& value : hand["quaternion"]) {
        ASSERT_TRUE(value.is_number()) << hand;
        squared += value.get<double>() * value.get<double>();
      }
      EXPECT_NEAR(squared, 1.0, 1e-9);
    }
  }
  EXPECT_GT(hand_poses, 0U);
}

TEST_F(LocalizeSensor, isGivenByAnOptionOrByTheFile)
{
  pcl::PointCloud<pcl::PointXYZ> points = tableFromOpposite();
  write("default.pcd", points);
  points.sensor_origin_ = {0.0F, 0.0F, -kOpposite, 0.0F};
  write("viewpoint.pcd", points);
  points.sensor_origin_ = {3.0F, 0.0F, 0.5F, 0.0F};
  write("wrong.pcd", points);
  write("own.pcd", unorganized(table()));
  const Json own = json("--viewpoint 0,0,0 own.pcd", 1);
  const Json given = json("--viewpoint " + kSensor + " default.pcd", 1);
  EXPECT_EQ(given["handles"].size(), own["handles"].size());
  EXPECT_GT(given["counts"]["concave"], 0);
  for (const Json& shell : given["shells"]) {
    const Json& centroid = shell["centroid"];
    const Eigen::Vector3d to_sensor(-centroid[0].get<double>(), -centroid[1].get<double>(),
                                    -kOpposite - centroid[2].get<double>());
    const Json& normal = shell["normal"];
    EXPECT_GT(to_sensor.dot(Eigen::Vector3d(normal[0], normal[1], normal[2])), 0.0);
  }
  expectSameShells(json("viewpoint.pcd", 1), given);
  expectSameShells(json("--viewpoint " + kSensor + " wrong.pcd", 1), given);
}

TEST_F(LocalizeSensor, ofARangeImageIsItsOrigin)
{
  pcl::PointCloud<pcl::PointXYZ> points = table();
  write("table.pcd", points);
  points.sensor_origin_ = {0.5F, -2.0F, 1.0F, 0.0F};  // its pose in the scene, as some files have it
  write("posed.pcd", points);
  const Json expected = json("table.pcd", 0);
  expectSameShells(json("posed.pcd", 0), expected);
  expectSameShells(json("--viewpoint -3,0.5,2 table.pcd", 0), expected);
}

/// The pose of a view in its VIEWPOINT is that of its sensor; another one, on the command line, is that of its frame.
TEST_F(LocalizeSensor, ofAViewIsTheOriginWhereItsViewpointSaysSo)
{
  pcl::PointCloud<pcl::PointXYZ> points = unorganized(table());
  write("default.pcd", points);
  points.sensor_origin_ = {0.5F, -2.0F, 1.0F, 0.0F};
  write("posed.pcd", points);
  const Json known = json("--view posed.pcd", 1);
  EXPECT_FALSE(known["shells"].at(0)["normal"].is_null());
  for (const char* view : {"default.pcd", "posed.pcd:0.5,-2,1,0,0,0,1"}) {
    const Json unknown = json(std::string("--view ") + view, 2);
    EXPECT_TRUE(unknown["shells"].at(0)["normal"].is_null()) << view;
    EXPECT_EQ(unknown["counts"]["concave"], 0) << view;
  }
}

}  // namespace
}  // namespace grasp_affordances
