#include "cli/localize_calls.h"
#include "support/recordings.h"
#include "support/sanitizers.h"

#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <rosbag/bag.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const char* const kLimitMemory = GRASP_AFFORDANCES_SANITIZER ? "true" : "ulimit -v 4000000";

class LocalizeBagTest : public LocalizeTest
{
protected:
  /// Two clouds, with a malformed one between them.
  void writeBag(const std::string& name, const std::vector<std::string>& topics) const
  {
    const auto points = table();
    sensor_msgs::PointCloud2 message;
    message.header.frame_id = "camera_optical";
    message.width = points.width;
    message.height = points.height;
    message.point_step = sizeof(pcl::PointXYZ);
    message.row_step = message.point_step * message.width;
    for (const char* field_name : {"x", "y", "z"}) {
      sensor_msgs::PointField field;
      field.name = field_name;
      field.offset = 4 * static_cast<std::uint32_t>(message.fields.size());
      field.datatype = sensor_msgs::PointField::FLOAT32;
      field.count = 1;
      message.fields.push_back(field);
    }
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(points.points.data());
    message.data.assign(bytes, bytes + points.size() * sizeof(pcl::PointXYZ));
    rosbag::Bag bag(path(name), rosbag::bagmode::Write);
    for (const std::string& topic : topics) {
      for (const std::uint32_t second : {10, 11, 12}) {
        message.header.stamp = ros::Time(second, 250000000);
        message.point_step = second == 11 ? 4 : sizeof(pcl::PointXYZ);
        bag.write(topic, ros::Time(second), message);
      }
    }
    bag.close();
  }
};

TEST_F(LocalizeBagTest, readsBagsAndGoesOnAfterMalformedMessages)
{
  writeBag("clouds.bag", {"/points"});
  write("table.pcd", table());
  const Call call = localize("--json --samples 1000 clouds.bag");
  EXPECT_EQ(call.status, 1);
  const std::vector<Json> results = call.json();
  ASSERT_EQ(results.size(), 2U);
  for (const Json& result : results) {
    EXPECT_EQ(result["file"], "clouds.bag");
    EXPECT_EQ(result["frame_id"], "camera_optical");
  }
  EXPECT_EQ(results[0]["stamp"], 10.25);
  EXPECT_EQ(results[1]["stamp"], 12.25);
  EXPECT_EQ(results[0]["shells"], localize("--json --samples 1000 table.pcd").json().at(0)["shells"]);
  ASSERT_EQ(lines(call.err).size(), 3U) << call.err;
  EXPECT_EQ(lines(call.err)[0].find("[1/3] clouds.bag: "), 0U) << call.err;
  EXPECT_EQ(lines(call.err)[1].find("clouds.bag: message 2/3: field y"), 0U) << call.err;
  EXPECT_EQ(lines(call.err)[2].find("[3/3] clouds.bag: "), 0U) << call.err;
}

TEST_F(LocalizeBagTest, choosesTheTopic)
{
  writeBag("clouds.bag", {"/left", "/right"});
  const Call ambiguous = localize("--json --samples 10 clouds.bag");
  EXPECT_EQ(ambiguous.status, 1);
  EXPECT_EQ(ambiguous.out, "");
  EXPECT_EQ(lines(ambiguous.err).size(), 1U);
  EXPECT_NE(ambiguous.err.find("/left, /right"), std::string::npos) << ambiguous.err;
  EXPECT_EQ(localize("--json --samples 10 --topic /left clouds.bag").json().size(), 2U);
  const Call absent = localize("--json --samples 10 --topic /up clouds.bag");
  EXPECT_EQ(absent.status, 1);
  EXPECT_NE(absent.err.find("no topic /up"), std::string::npos) << absent.err;
}

TEST_F(LocalizeBagTest, readsTopicsThatAreNoNamesOfRos)
{
  writeBag("clouds.bag", {"/my points", "/points"});
  EXPECT_EQ(localize("--json --samples 10 --topic /points clouds.bag").json().size(), 2U);
  EXPECT_EQ(localize("--json --samples 10 --topic '/my points' clouds.bag").json().size(), 2U);
  const Call ambiguous = localize("--json --samples 10 clouds.bag");
  EXPECT_EQ(ambiguous.status, 1);
  EXPECT_NE(ambiguous.err.find("choose one: '/my points', /points"), std::string::npos) << ambiguous.err;
}

TEST_F(LocalizeBagTest, decidesByTheFirstBytes)
{
  for (const char* name : {"CLOUDS.BAG", "clouds.bag.active", "clouds"}) {
    writeBag(name, {"/points"});
    EXPECT_EQ(localize(std::string("--json --samples 10 ") + name).json().size(), 2U) << name;
  }
  write("table.bag", table());
  const Call call = localize("--json --samples 10 table.bag");
  EXPECT_EQ(call.status, 0) << call.err;
  EXPECT_EQ(call.json().size(), 1U);
}

TEST_F(LocalizeBagTest, saysThatABagWasNotClosed)
{
  writeBag("clouds.bag", {"/points"});
  std::string text = content("clouds.bag");
  const std::size_t index = text.find("index_pos=");
  ASSERT_NE(index, std::string::npos);
  text.replace(index + 10, 8, std::string(8, '\0'));
  const Call call = localize("--json " + writeText("clouds.bag.active", text));
  EXPECT_EQ(call.status, 1);
  EXPECT_EQ(call.err,
            "clouds.bag.active: the bag was not closed, so that it has no index (rosbag reindex makes one)\n");
}

TEST_F(LocalizeTest, saysWhatAFileIs)
{
  const std::vector<std::pair<std::string, std::string>> cases{
      {".", "is a folder"},
      {"missing.bag", "No such file or directory"},
      {writeText("empty.pcd", ""), "is empty"},
      {writeText("empty.bag", ""), "is empty"},
      {writeText("text.bag", "hello\n"), "no PCD file and no bag, but text"},
      {writeText("cloud.ply", "ply\nformat ascii 1.0\nend_header\n"), "no PCD file and no bag, but a PLY file"},
      {writeText("pointer.pcd", "version https://git-lfs.github.com/spec/v1\n"),
       "no PCD file and no bag, but a pointer of Git LFS (git lfs pull gets the file)"},
  };
  for (const auto& [file, words] : cases) {
    const Call call = localize("--json " + file);
    EXPECT_EQ(call.status, 1);
    EXPECT_EQ(call.err, file + ": " + words + "\n");
  }
  const Call view = localize("--json --view " + writeText("a.bag", "#ROSBAG V2.0\n") + " --view cloud.ply");
  EXPECT_EQ(view.status, 1);
  ASSERT_EQ(lines(view.err).size(), 2U) << view.err;
  EXPECT_EQ(lines(view.err)[0], "a.bag: no PCD file, but a bag");
}

TEST_F(LocalizeTest, readsTheRecordedBag)
{
  REQUIRE_RECORDINGS(recordings);
  const Call call = localize("--json --capture-radius 0.045 " + recordings + "/bags/soda_can.bag");
  EXPECT_EQ(call.status, 0);
  EXPECT_EQ(call.err, "");
  const Json json = call.json().at(0);
  EXPECT_EQ(json["frame_id"], "camera_rgb_optical_frame");
  EXPECT_NEAR(json["stamp"], 1527473951.980784, 1e-6);
  EXPECT_FALSE(json["shells"].empty());
}

TEST_F(LocalizeTest, reportsUnreadableInputsInOneLineAndGoesOn)
{
  write("table.pcd", table());
  const std::string whole = content("table.pcd");
  const auto header = [](const std::string& fields, const std::string& width) {
    return "VERSION 0.7\nFIELDS " + fields + "\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + width +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + width + "\nDATA binary\n" + std::string(24, 'x');
  };
  const std::vector<std::string> bad{
      "missing.pcd",
      "missing.bag",
      ".",
      writeText("empty.pcd", ""),
      writeText("empty.bag", ""),
      writeText("text.pcd", "hello\n"),
      writeText("text.bag", "hello\n"),
      writeText("truncated.pcd", whole.substr(0, whole.size() / 2)),
      writeText("absurd.pcd", header("x y z", "4000000000")),
      writeText("no_z.pcd", header("x y w", "2")),
  };
  for (const std::string& file : bad) {
    SCOPED_TRACE(file);
    const Call call = localize("--json --samples 100 " + file, kLimitMemory);
    EXPECT_EQ(call.status, 1);
    EXPECT_EQ(call.out, "");
    EXPECT_EQ(lines(call.err).size(), 1U) << call.err;
    EXPECT_EQ(call.err.find(file + ": "), 0U) << call.err;
    EXPECT_GT(call.err.size(), file.size() + 5) << "no reason given";
    EXPECT_EQ(call.err.find("bad_alloc"), std::string::npos) << call.err;
  }
  const Call mixed = localize("--json --samples 3000 missing.pcd table.pcd text.pcd table.pcd");
  EXPECT_EQ(mixed.status, 1);
  EXPECT_EQ(mixed.json().size(), 2U);
  ASSERT_EQ(lines(mixed.err).size(), 4U) << mixed.err;
  EXPECT_EQ(lines(mixed.err)[1].find("[2/4] table.pcd: "), 0U) << mixed.err;
  EXPECT_NE(lines(mixed.err)[1].find(" handles, "), std::string::npos) << mixed.err;
}

/// Clouds that hold nothing to localize, or hold it in an odd way.
class OddClouds : public LocalizeTest
{
protected:
  void expectDone(const std::string& file, const std::string& reason) const
  {
    SCOPED_TRACE(file);
    const Call call = localize("--json --samples 500 --threads 2 " + file);
    EXPECT_EQ(call.status, 0) << call.err;
    ASSERT_EQ(call.json().size(), 1U);
    EXPECT_TRUE(call.json().at(0)["shells"].empty());
    EXPECT_EQ(lines(call.err).size(), 1U) << call.err;
    EXPECT_NE(call.err.find(reason), std::string::npos) << call.err;
    EXPECT_EQ(call.err.find(file + ": "), 0U) << call.err;
  }
};

TEST_F(OddClouds, withNothingToLocalizeSayWhyInOneLine)
{
  const pcl::PointCloud<pcl::PointXYZ> good = table();
  pcl::PointCloud<pcl::PointXYZ> cloud(640, 480);
  const auto fill = [&](float x, float y, float z) { std::fill(cloud.begin(), cloud.end(), pcl::PointXYZ(x, y, z)); };
  fill(kNan, kNan, kNan);
  expectDone(write("nan.pcd", cloud), "all points are NaN, zero or infinite");
  fill(0.1F, 0.2F, kNan);
  expectDone(write("z_nan.pcd", cloud), "all points are NaN, zero or infinite");
  fill(std::numeric_limits<float>::infinity(), 0.2F, 1.0F);
  expectDone(write("infinite.pcd", cloud), "all points are NaN, zero or infinite");
  fill(0.0F, 0.0F, 0.0F);
  expectDone(write("zeros.pcd", cloud), "all points are NaN, zero or infinite");
  fill(0.1F, 0.2F, 1.0F);
  expectDone(write("equal.pcd", cloud), "coincide");
  expectDone(writeText("empty.pcd",
                       "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 0\nHEIGHT 1\n"
                       "POINTS 0\nDATA ascii\n"),
             "empty");
  pcl::PointCloud<pcl::PointXYZ> wall = good;  // on the pixels' rays, at a depth of 1 m
  for (std::size_t i = 0; i < wall.size(); ++i) {
    const std::size_t u = i % 640, v = i / 640;
    wall[i] = {(u - 319.5F) / 525.0F, (v - 239.5F) / 525.0F, 1.0F};
  }
  expectDone(write("wall.pcd", wall), "No handle: of 500 samples 500 ended ");
}

TEST_F(OddClouds, unmeasuredPointsChangeNothing)
{
  pcl::PointCloud<pcl::PointXYZ> points = table();
  write("table.pcd", points);
  int which = 0;
  for (auto& point : points) {
    if (!std::isfinite(point.z)) {
      const float infinity = std::numeric_limits<float>::infinity();
      const pcl::PointXYZ unmeasured[] = {
          {0.1F, 0.2F, kNan}, {0.0F, 0.0F, 0.0F}, {infinity, 0.0F, 1.0F}, {1e30F, 0.0F, 1.0F}};
      point = unmeasured[which++ % 4];
    }
  }
  ASSERT_GT(which, 100);
  write("odd.pcd", points);
  const Json expected = localize("--json --samples 2000 table.pcd").json().at(0);
  const Json odd = localize("--json --samples 2000 odd.pcd").json().at(0);
  EXPECT_EQ(odd["shells"], expected["shells"]);
  EXPECT_EQ(odd["counts"], expected["counts"]);
}

TEST_F(OddClouds, outOfTheirOpticalFrameAreHandledAsUnorganized)
{
  pcl::PointCloud<pcl::PointXYZ> points = table();
  for (auto& point : points) {
    point = {point.z, -point.x, -point.y};
  }
  points.sensor_origin_.setZero();
  write("turned.pcd", points);
  for (auto& point : points) {
    point = {point.x, point.y, -point.z - 1.0F};
  }
  write("behind.pcd", points);
  for (const char* file : {"turned.pcd", "behind.pcd"}) {
    SCOPED_TRACE(file);
    const Call call = localize(std::string("--json --samples 2000 ") + file);
    EXPECT_EQ(call.status, 0);
    ASSERT_EQ(lines(call.err).size(), 2U) << call.err;
    EXPECT_NE(lines(call.err)[1].find("the place of the sensor is not known"), std::string::npos) << call.err;
    EXPECT_FALSE(call.json().at(0)["shells"].empty());
    EXPECT_TRUE(call.json().at(0)["shells"][0]["observed_free"].is_null());
  }
}

}  // namespace
}  // namespace grasp_affordances
