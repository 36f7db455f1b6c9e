#include "io/pcd.h"

#include "support/pcd_files.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <limits>
#include <random>
#include <string>

namespace grasp_affordances::test
{
namespace
{

TEST_F(PcdTest, readsEveryEncoding)
{
  Header header;
  expectTwoPoints(readPcdCloud(write(header.text() + kTwoPoints)));
  header.data = "DATA ascii\n";
  expectTwoPoints(readPcdCloud(write(header.text() + "1 2 3\n4 5 6\n")));
  expectTwoPoints(readPcdCloud(write(header.text() + "1 2 3\n\n4.0e0 5 +6")));
  header.data = "DATA binary_compressed\n";
  expectTwoPoints(readPcdCloud(write(header.text() + block(kTwoPointsByField))));
}

TEST_F(PcdTest, skipsUnknownLinesOfTheHeader)
{
  Header header;
  header.viewpoint += "TIMESTAMP 12 34\nnonsense\n";
  expectTwoPoints(readPcdCloud(write(header.text() + kTwoPoints)));
  expectTwoPoints(readPcdCloud(write("\xEF\xBB\xBF" + Header().text() + kTwoPoints)));  // a byte order mark
  expectTwoPoints(readPcdCloud(write("CREATOR me\n" + header.text() + kTwoPoints)));
}

TEST_F(PcdTest, readsWhatPclWrites)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> points(5, 4);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-2.0F, 2.0F);
  for (auto& point : points) {
    point.x = uniform(random);
    point.y = uniform(random);
    point.z = uniform(random);
    point.rgba = random();
  }
  points[7].x = points[7].y = points[7].z = std::numeric_limits<float>::quiet_NaN();
  points.is_dense = false;
  points.sensor_origin_ = {0.5F, -1.0F, 2.0F, 0.0F};
  pcl::PCLPointCloud2 padded;  // with the padding that PCL's point types hold
  pcl::toPCLPointCloud2(points, padded);
  const std::string path = folder_ / "cloud.pcd";
  pcl::PCDWriter writer;
  const auto check = [&](const char* encoding) {
    SCOPED_TRACE(encoding);
    const Cloud cloud = readPcdCloud(path);
    EXPECT_EQ(cloud.width, 5U);
    EXPECT_EQ(cloud.height, 4U);
    EXPECT_TRUE(cloud.organized());
    EXPECT_EQ(cloud.sensor_origin.value(), Eigen::Vector3f(0.5F, -1.0F, 2.0F));
    ASSERT_EQ(cloud.size(), points.size());
    EXPECT_FALSE(cloud.measured(7));
    const float tolerance = std::string(encoding) == "ascii" ? 1e-7F : 0.0F;  // it is written with 8 digits
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i != 7) {
        EXPECT_LE((cloud.point(i) - points[i].getVector3fMap()).cwiseAbs().maxCoeff(), tolerance) << "point " << i;
      }
    }
  };
  const Eigen::Vector4f& origin = points.sensor_origin_;
  const Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  ASSERT_EQ(writer.writeASCII(path, padded, origin, rotation), 0);
  check("ascii");
  ASSERT_EQ(writer.writeBinary(path, padded, origin, rotation), 0);
  check("binary");
  ASSERT_EQ(writer.writeBinaryCompressed(path, padded, origin, rotation), 0);
  check("compressed");
  EXPECT_EQ(readPcd(path).fields.size(), 8U) << "x y z normal_x normal_y normal_z rgb curvature";
}

TEST_F(PcdTest, readsTheViewpointWithQwFirst)
{
  Header header;
  header.viewpoint = "VIEWPOINT 1 -2 0.5 0.5 -0.5 0.1 0.7\n";
  SensorPose viewpoint;
  readPcd(write(header.text() + kTwoPoints), &viewpoint);
  EXPECT_EQ(viewpoint.position, Eigen::Vector3d(1, -2, 0.5));
  EXPECT_EQ(viewpoint.orientation.w(), 0.5);
  EXPECT_EQ(viewpoint.orientation.vec(), Eigen::Vector3d(-0.5, 0.1, 0.7));
  EXPECT_EQ(readPcdCloud(write(header.text() + kTwoPoints)).sensor_origin.value(), Eigen::Vector3f(1, -2, 0.5));

  // As PCL means it: a quarter turn about z takes x to y.
  pcl::PointCloud<pcl::PointXYZ> points(1, 1);
  points.sensor_origin_ = {0.1F, 0.2F, 0.3F, 0.0F};
  points.sensor_orientation_ = Eigen::AngleAxisf(1.5707963F, Eigen::Vector3f::UnitZ());
  const std::string path = folder_ / "turned.pcd";
  ASSERT_EQ(pcl::PCDWriter().writeBinary(path, points), 0);
  readPcd(path, &viewpoint);
  const auto transform = viewpoint.transform();
  ASSERT_TRUE(transform);
  EXPECT_TRUE((*transform * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0.1, 1.2, 0.3), 1e-5));
}

TEST_F(PcdTest, theDefaultViewpointSaysNothingOfTheSensor)
{
  const auto origin = [&](const std::string& viewpoint) {
    Header header;
    header.viewpoint = viewpoint;
    return readPcdCloud(write(header.text() + kTwoPoints)).sensor_origin;
  };
  for (const char* viewpoint : {"", "VIEWPOINT 0 0 0 1 0 0 0\n", "VIEWPOINT 0 0 0 0 0 0 0\n"}) {
    EXPECT_FALSE(origin(viewpoint)) << viewpoint;
  }
  EXPECT_EQ(origin("VIEWPOINT 0 0 0.25 1 0 0 0\n").value(), Eigen::Vector3f(0, 0, 0.25));
  EXPECT_EQ(origin("VIEWPOINT 0 0 0 0.6 0 0.8 0\n").value(), Eigen::Vector3f(0, 0, 0)) << "turned, so somebody gave it";
}

TEST_F(PcdTest, aPoseNeedsAUnitQuaternionAndFiniteNumbers)
{
  const auto has_transform = [](double w, double x) {
    return SensorPose{Eigen::Vector3d::Zero(), Eigen::Quaterniond(w, x, 0, 0)}.transform().has_value();
  };
  EXPECT_TRUE(has_transform(1.0009, 0));
  EXPECT_FALSE(has_transform(1.0011, 0));
  EXPECT_FALSE(has_transform(0.9989, 0));
  EXPECT_FALSE(has_transform(0, 0));
  EXPECT_FALSE(has_transform(1, 1));
  EXPECT_FALSE(has_transform(std::numeric_limits<double>::quiet_NaN(), 0));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE((SensorPose{{0, infinity, 0}, Eigen::Quaterniond::Identity()}.transform()));
  const auto rounded = SensorPose{{1, 2, 3}, Eigen::Quaterniond(0.7071, 0.7071, 0, 0)}.transform();
  ASSERT_TRUE(rounded);
  EXPECT_NEAR(rounded->linear().determinant(), 1.0, 1e-12) << "normalized";
}

TEST_F(PcdTest, readsOtherLayouts)
{
  Header header;
  header.fields = "FIELDS label z y x\nSIZE 1 8 4 4\nTYPE U F F F\nCOUNT 2 1 1 1\n";
  header.extent = "WIDTH 1\nHEIGHT 1\n";
  header.points = "POINTS 1\n";
  const double z = 3.0;
  const std::string point = "ab" + std::string(reinterpret_cast<const char*>(&z), sizeof(z)) + bytes({2, 1});
  EXPECT_EQ(readPcdCloud(write(header.text() + point)).point(0), Eigen::Vector3f(1, 2, 3));

  expectTwoPoints(readPcdCloud(write("VERSION .5\nCOLUMNS x y z\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n")));
  std::string dos = Header().text();
  for (std::size_t at = 0; (at = dos.find('\n', at)) != std::string::npos; at += 2) {
    dos.replace(at, 1, "\r\n");
  }
  expectTwoPoints(readPcdCloud(write(dos + kTwoPoints)));
}

TEST_F(PcdTest, readsFilesWithoutPoints)
{
  Header header;
  header.points = "POINTS 0\n";
  for (const char* extent : {"WIDTH 0\nHEIGHT 0\n", "WIDTH 0\nHEIGHT 1\n", "WIDTH 4000000000\nHEIGHT 0\n", ""}) {
    for (const char* data : {"DATA ascii\n", "DATA binary\n", "DATA binary_compressed\n"}) {
      header.extent = extent;
      header.data = data;
      EXPECT_EQ(readPcdCloud(write(header.text())).size(), 0U) << extent << data;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
