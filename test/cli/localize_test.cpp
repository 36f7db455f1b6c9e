#include "cli/command_line_test.h"
#include "io/bag.h"
#include "io/pcd.h"
#include "support/recordings.h"
#include "support/sanitizers.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <rosbag/bag.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const char* const kLimitMemory = GRASP_AFFORDANCES_SANITIZER ? "true" : "ulimit -v 4000000";

std::vector<std::string> lines(const std::string& text)
{
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    result.push_back(line);
  }
  return result;
}

/// How a call of `localize` ended.
struct Call
{
  int status;
  std::string out, err;

  std::vector<Json> json() const
  {
    std::vector<Json> clouds;
    for (const std::string& line : lines(out)) {
      clouds.push_back(Json::parse(line));
    }
    return clouds;
  }
};

class LocalizeTest : public test::CommandLineTest
{
protected:
  /// @param limits  shell command before the call
  Call localize(const std::string& arguments, const std::string& limits = "true") const
  {
    const int status = run(limits + " && exec " LOCALIZE " " + arguments);
    return {status, content("stdout"), content("stderr")};
  }

  template <typename PointT>
  std::string write(const std::string& name, const pcl::PointCloud<PointT>& points) const
  {
    pcl::PCDWriter().writeBinary(path(name), points);
    return name;
  }

  std::string writeText(const std::string& name, const std::string& text) const
  {
    std::ofstream(path(name), std::ios::binary) << text;
    return name;
  }

  static pcl::PointCloud<pcl::PointXYZ> table()
  {
    const Cloud cloud = test::captureScene("table", 3).cloud;
    pcl::PointCloud<pcl::PointXYZ> points(cloud.width, cloud.height);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].getVector3fMap() = cloud.point(i);
    }
    return points;
  }

  /// The measured points of a cloud only.
  static pcl::PointCloud<pcl::PointXYZ> unorganized(const pcl::PointCloud<pcl::PointXYZ>& points)
  {
    pcl::PointCloud<pcl::PointXYZ> result;
    std::copy_if(points.begin(), points.end(), std::back_inserter(result),
                 [](const pcl::PointXYZ& point) { return std::isfinite(point.z); });
    return result;
  }
};

Eigen::Vector3d vector(const Json& json)
{
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

std::set<std::string> keys(const Json& json)
{
  std::set<std::string> names;
  for (auto entry = json.begin(); entry != json.end(); ++entry) {
    names.insert(entry.key());
  }
  return names;
}

/// Points of the cloud over a shell's length, with a radial distance above `from` and up to `to`; `slack` m more or
/// less.
int countPoints(const Cloud& cloud, const Json& shell, double from, double to, double slack)
{
  const Eigen::Vector3d centroid = vector(shell["centroid"]);
  const Eigen::Vector3d axis = vector(shell["axis"]);
  const double half_length = 0.5 * shell["length"].get<double>() + slack;
  int count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.measured(i)) {
      continue;
    }
    const Eigen::Vector3d offset = cloud.point(i).cast<double>() - centroid;
    const double along = offset.dot(axis);
    const double radial = (offset - along * axis).norm();
    count += std::abs(along) <= half_length && radial > from - slack && radial <= to + slack;
  }
  return count;
}

/// Expects what the design says of every shell, the counts of points included.
void expectShell(const Cloud& cloud, const Json& shell, bool has_curvature, bool has_range_image)
{
  SCOPED_TRACE(shell.dump());
  EXPECT_EQ(keys(shell),
            (std::set<std::string>{"centroid", "axis", "normal", "inner_radius", "thickness", "length", "curvature",
                                   "points_inside", "points_in_gap", "observed_free", "point_index"}));
  const Eigen::Vector3d axis = vector(shell["axis"]);
  const Eigen::Vector3d normal = vector(shell["normal"]);
  EXPECT_NEAR(axis.norm(), 1.0, 1e-9);
  EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
  EXPECT_NEAR(axis.dot(normal), 0.0, 1e-9);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  EXPECT_GT(axis[largest], 0.0);
  EXPECT_LT(normal.dot(vector(shell["centroid"])), 0.0) << "towards the sensor at the origin";

  const double radius = shell["inner_radius"];
  const double thickness = shell["thickness"];
  constexpr double kRounding = 1e-6;  // m; float coordinates at 1 m are 1e-7 apart
  const double zero = -1.0;           // points on the axis are inside
  EXPECT_LE(countPoints(cloud, shell, zero, radius, -kRounding), shell["points_inside"].get<int>());
  EXPECT_GE(countPoints(cloud, shell, zero, radius, kRounding), shell["points_inside"].get<int>());
  EXPECT_LE(countPoints(cloud, shell, radius, radius + thickness, -kRounding), shell["points_in_gap"].get<int>());
  EXPECT_GE(countPoints(cloud, shell, radius, radius + thickness, kRounding), shell["points_in_gap"].get<int>());

  const std::size_t index = shell["point_index"];
  ASSERT_LT(index, cloud.size());
  EXPECT_TRUE(cloud.measured(index));
  EXPECT_EQ(shell["curvature"].is_null(), !has_curvature);
  EXPECT_EQ(shell["observed_free"].is_null(), !has_range_image);
  if (has_range_image) {
    EXPECT_GE(shell["observed_free"], 0.0);
    EXPECT_LE(shell["observed_free"], 1.0);
  }
}

void expectUnit(const Json& json, const char* what)
{
  EXPECT_NEAR(vector(json).norm(), 1.0, 1e-9) << what;
}

/// Expects what the design says of every hand pose: the quaternion's x, y and z are the approach, the direction in
/// which fingers and thumb oppose, and the axis.
void expectHandPose(const Json& hand)
{
  SCOPED_TRACE(hand.dump());
  EXPECT_EQ(keys(hand),
            (std::set<std::string>{"position", "approach", "axis", "quaternion", "width", "observed_free", "score"}));
  const Json& q = hand["quaternion"];
  const Eigen::Quaterniond rotation(q.at(3).get<double>(), q.at(0).get<double>(), q.at(1).get<double>(),
                                    q.at(2).get<double>());
  EXPECT_NEAR(rotation.norm(), 1.0, 1e-9);
  EXPECT_LT((rotation * Eigen::Vector3d::UnitX() - vector(hand["approach"])).norm(), 1e-9);
  EXPECT_LT((rotation * Eigen::Vector3d::UnitZ() - vector(hand["axis"])).norm(), 1e-9);
  EXPECT_GT(hand["width"], 0.0);
  EXPECT_GE(hand["score"], 0.0);
  EXPECT_LE(hand["score"], 1.0);
}

/// Expects what the design says of every handle.
void expectHandle(const Json& json, const Json& handle)
{
  SCOPED_TRACE(handle.dump());
  EXPECT_EQ(keys(handle),
            (std::set<std::string>{"id", "centroid", "axis", "normal", "radius", "inner_radius", "length", "polyline",
                                   "shells", "score", "agreement", "clearance", "observed_free", "hand_poses"}));
  expectUnit(handle["axis"], "axis");
  expectUnit(handle["normal"], "normal");
  EXPECT_NEAR(vector(handle["axis"]).dot(vector(handle["normal"])), 0.0, 1e-6);
  EXPECT_GE(handle["polyline"].size(), 2U);
  for (const Json& point : handle["polyline"]) {
    EXPECT_LE((vector(point) - vector(handle["centroid"])).norm(), handle["length"].get<double>() + 1e-6);
  }
  EXPECT_GT(handle["radius"], 0.0);
  EXPECT_GE(handle["score"], 0.0);
  EXPECT_LE(handle["score"], 1.0);
  EXPECT_FALSE(handle["shells"].empty());
  for (const Json& shell : handle["shells"]) {
    EXPECT_LT(shell, json["shells"].size());
  }
  for (const Json& hand : handle["hand_poses"]) {
    expectHandPose(hand);
  }
}

void expectContract(const Json& json, const Cloud& cloud, int samples, bool has_curvature, bool has_range_image)
{
  EXPECT_EQ(keys(json), (std::set<std::string>{"file", "frame_id", "stamp", "preset", "seed", "threads", "points",
                                               "counts", "milliseconds", "shells", "handles"}));
  std::size_t measured = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    measured += cloud.measured(i);
  }
  EXPECT_EQ(json["points"], measured);
  int ended = 0;
  for (auto count = json["counts"].begin(); count != json["counts"].end(); ++count) {
    ended += count.key() == "sampled" ? 0 : count.value().get<int>();
  }
  EXPECT_EQ(json["counts"]["sampled"], samples);
  EXPECT_EQ(ended, samples);
  EXPECT_EQ(json["counts"]["shells"], json["shells"].size());
  for (const char* name : {"too_few_points", "degenerate", "occluded", "low_curvature", "concave", "no_shell"}) {
    EXPECT_TRUE(json["counts"].count(name)) << name;
  }
  for (const char* name : {"total", "neighborhoods", "occlusion", "fit", "shell", "handles", "hand_poses"}) {
    EXPECT_GE(json["milliseconds"].at(name), 0.0) << name;
  }
  for (std::size_t i = 0; i < json["handles"].size(); ++i) {
    EXPECT_EQ(json["handles"][i]["id"], i + 1) << "the best first";
    expectHandle(json, json["handles"][i]);
  }
  EXPECT_FALSE(json["shells"].empty());
  const std::size_t step = json["shells"].size() / 20 + 1;
  for (std::size_t i = 0; i < json["shells"].size(); i += step) {
    expectShell(cloud, json["shells"][i], has_curvature, has_range_image);
  }
}

TEST_F(LocalizeTest, printsTheDocumentedJson)
{
  write("table.pcd", table());
  const Cloud cloud = readPcdCloud(path("table.pcd"));
  for (const std::string preset : {"localizer", "paper"}) {
    for (const std::string estimator : {"taubin", "pca", "normals"}) {
      SCOPED_TRACE(preset + " " + estimator);
      const Call call = localize("--json --seed 5 --samples 3000 --threads 2 --preset " + preset + " --estimator " +
                                 estimator + " table.pcd");
      EXPECT_EQ(call.status, 0);
      EXPECT_EQ(call.err, "");
      ASSERT_EQ(call.json().size(), 1U);
      const Json json = call.json().front();
      EXPECT_EQ(json["file"], "table.pcd");
      EXPECT_EQ(json["frame_id"], "");
      EXPECT_EQ(json["stamp"], 0.0);
      EXPECT_EQ(json["preset"], preset);
      EXPECT_EQ(json["seed"], 5);
      EXPECT_EQ(json["threads"], 2);
      expectContract(json, cloud, 3000, estimator == "taubin", true);
      EXPECT_FALSE(json["handles"].empty());
    }
  }
}

TEST_F(LocalizeTest, printsTheDocumentedJsonForRecordings)
{
  REQUIRE_RECORDINGS(recordings);
  for (const char* name : {"/mosd/learn33.pcd", "/mosd/learn44.pcd", "/pcl/milk_cartoon_all_small_clorox.pcd"}) {
    SCOPED_TRACE(name);
    const Call call = localize("--json --capture-radius 0.048 " + recordings + name);
    EXPECT_EQ(call.status, 0);
    EXPECT_EQ(call.err, "");
    expectContract(call.json().at(0), readPcdCloud(recordings + name), 2000, true, true);
  }
}

TEST_F(LocalizeTest, warnsOnceOfUnorganizedClouds)
{
  write("unorganized.pcd", unorganized(table()));
  const Call call = localize("--json --samples 2000 unorganized.pcd");
  EXPECT_EQ(call.status, 0);
  ASSERT_EQ(lines(call.err).size(), 1U) << call.err;
  EXPECT_EQ(call.err.find("unorganized.pcd: "), 0U) << call.err;
  EXPECT_NE(call.err.find("not organized"), std::string::npos) << call.err;
  expectContract(call.json().at(0), readPcdCloud(path("unorganized.pcd")), 2000, true, false);
}

TEST_F(LocalizeTest, answersTheSameForAnyNumberOfThreads)
{
  write("table.pcd", table());
  write("unorganized.pcd", unorganized(table()));
  std::string clouds = "table.pcd unorganized.pcd table.pcd";
  const std::string recordings = test::recordingsFolder();
  if (!recordings.empty()) {
    clouds += " " + recordings + "/mosd/learn44.pcd " + recordings + "/bags/soda_can.bag";
  }
  const std::vector<std::string> calls{clouds, "--preset paper " + clouds,
                                       "--estimator pca --neighborhood knn " + clouds, "--estimator normals table.pcd"};
  for (const std::string& arguments : calls) {
    std::vector<Json> expected;
    for (const int threads : {1, 2, 3, 8}) {
      for (int repetition = 0; repetition < 2; ++repetition) {
        SCOPED_TRACE(arguments + " threads " + std::to_string(threads));
        const Call call = localize("--json --samples 1000 --capture-radius 0.045 --threads " + std::to_string(threads) +
                                   " " + arguments);
        EXPECT_EQ(call.status, 0);
        std::vector<Json> results = call.json();
        for (Json& result : results) {
          EXPECT_EQ(result["threads"], threads);
          EXPECT_FALSE(result["shells"].empty()) << result["file"];
          result.erase("threads");
          result.erase("milliseconds");
        }
        expected = expected.empty() ? results : expected;
        EXPECT_EQ(results, expected);
        if (results.size() > 2) {
          EXPECT_EQ(results[0], results[2]) << "a cloud's result depends on the clouds before it";
        }
      }
    }
  }
}

TEST_F(LocalizeTest, differentSeedsDrawDifferentSamples)
{
  write("table.pcd", table());
  const Json first = localize("--json --samples 2000 table.pcd").json().at(0);
  const Json second = localize("--json --samples 2000 --seed 2 table.pcd").json().at(0);
  EXPECT_EQ(first["seed"], 1);
  EXPECT_NE(first["shells"], second["shells"]);
}

TEST_F(LocalizeTest, resolvesTheNumberOfThreads)
{
  write("table.pcd", table());
  EXPECT_GE(localize("--json --samples 10 table.pcd").json().at(0)["threads"], 1);
}

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
    EXPECT_EQ(lines(call.err).size(), 1U) << call.err;
    EXPECT_FALSE(call.json().at(0)["shells"].empty());
    EXPECT_TRUE(call.json().at(0)["shells"][0]["observed_free"].is_null());
  }
}

TEST_F(LocalizeTest, refusesBadUsageAndParameters)
{
  write("table.pcd", table());
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"", {"no cloud"}},
      {"--nonsense table.pcd", {"--nonsense"}},
      {"--samples", {"--samples"}},
      {"--samples 0 table.pcd", {"sampling/samples", "0", "[1, "}},
      {"--samples -5 table.pcd", {"sampling/samples", "-5", "[1, "}},
      {"--samples many table.pcd", {"sampling/samples", "many"}},
      {"--samples 3.5 table.pcd", {"sampling/samples", "3.5"}},
      {"--samples 99999999999 table.pcd", {"sampling/samples", "99999999999"}},
      {"--samples '' table.pcd", {"sampling/samples"}},
      {"--samples 1 --samples 2 table.pcd", {"--samples"}},
      {"--capture-radius 0 table.pcd", {"hand/capture_radius", "0", "[0.002, "}},
      {"--capture-radius nan table.pcd", {"hand/capture_radius", "nan"}},
      {"--capture-radius inf table.pcd", {"hand/capture_radius", "inf"}},
      {"--finger-thickness 5 table.pcd", {"hand/finger_thickness", "5"}},
      {"--min-length -1 table.pcd", {"shell/min_length", "-1"}},
      {"--threads -1 table.pcd", {"threads", "-1"}},
      {"--seed -1 table.pcd", {"sampling/seed"}},
      {"--neighborhood cube table.pcd", {"neighborhood/kind", "cube", "radius, knn"}},
      {"--estimator ransac table.pcd", {"estimation/estimator", "ransac", "taubin, pca, normals"}},
      {"--preset thesis table.pcd", {"preset", "thesis", "localizer, paper"}},
      {"--config missing.yaml table.pcd", {"missing.yaml"}},
      {"--config " + writeText("unknown.yaml", "hand: {reach: 1}") + " table.pcd", {"unknown.yaml", "hand/reach"}},
      {"--config " + writeText("range.yaml", "hand: {capture_radius: 7}") + " table.pcd",
       {"hand/capture_radius", "7", "0.5"}},
      {"--config " + writeText("list.yaml", "[1, 2]") + " table.pcd", {"list.yaml"}},
      {"--config " + writeText("broken.yaml", "hand: {") + " table.pcd", {"broken.yaml"}},
      {"--preset localizer --config " + writeText("paper.yaml", "preset: paper") + " table.pcd",
       {"localizer", "paper"}},
  };
  for (const auto& [arguments, words] : cases) {
    SCOPED_TRACE(arguments);
    const Call call = localize("--json " + arguments);
    EXPECT_EQ(call.status, 2);
    EXPECT_EQ(call.out, "");
    EXPECT_EQ(lines(call.err).size(), 1U) << call.err;
    for (const std::string& word : words) {
      EXPECT_NE(call.err.find(word), std::string::npos) << "'" << word << "' is missing in: " << call.err;
    }
  }
}

TEST_F(LocalizeTest, readsConfigOverPresetAndOptionsOverBoth)
{
  write("table.pcd", table());
  writeText("values.yaml", "sampling: {samples: 70, seed: 9}\nhand: {finger_thickness: 0.01}");
  writeText("paper.yaml", "preset: paper\nsampling: {samples: 80}");
  const auto call = [this](const std::string& options) {
    const Json json = localize("--json " + options + " table.pcd").json().at(0);
    return json["preset"].get<std::string>() + " " + json["counts"]["sampled"].dump() + " " + json["seed"].dump();
  };
  EXPECT_EQ(call(""), "localizer 2000 1");
  EXPECT_EQ(call("--preset paper"), "paper 4000 1");
  EXPECT_EQ(call("--config values.yaml"), "localizer 70 9");
  EXPECT_EQ(call("--config values.yaml --preset paper --seed 4"), "paper 70 4");
  EXPECT_EQ(call("--config paper.yaml"), "paper 80 1");
  EXPECT_EQ(call("--config paper.yaml --preset paper --samples 60"), "paper 60 1");
  const Json wide = localize("--json --samples 2000 --finger-thickness 0.005 --min-length 0.05 table.pcd").json().at(0);
  ASSERT_FALSE(wide["shells"].empty());
  for (const Json& shell : wide["shells"]) {
    EXPECT_EQ(shell["thickness"], 0.005);
    EXPECT_GE(shell["length"], 0.05 - 1e-9);
  }
  const Json paper = localize("--json --samples 2000 --preset paper --min-length 0.05 table.pcd").json().at(0);
  ASSERT_FALSE(paper["shells"].empty());
  for (const Json& shell : paper["shells"]) {
    EXPECT_GE(shell["length"], 0.05 - 1e-9) << "measured, since a least length is asked for";
  }
}

TEST_F(LocalizeTest, drawsPictures)
{
  write("table.pcd", table());
  write("unorganized.pcd", unorganized(table()));
  const Call call = localize("--samples 2000 --picture out.v1.png table.pcd missing.pcd unorganized.pcd");
  EXPECT_EQ(call.status, 1);
  const std::string kSignature("\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR\0\0\x05\0\0\0\x03\xC0", 24);  // 1280 x 960
  EXPECT_EQ(content("out.v1.png").substr(0, 24), kSignature);
  EXPECT_EQ(content("out.v1-2.png").substr(0, 24), kSignature);
  EXPECT_FALSE(std::filesystem::exists(path("out.v1-3.png")));

  const Call unwritable = localize("--json --samples 100 --picture nowhere/out.png table.pcd");
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_EQ(unwritable.json().size(), 1U) << "the result is printed all the same";
  EXPECT_NE(unwritable.err.find("nowhere/out.png: No such file"), std::string::npos) << unwritable.err;
}

TEST_F(LocalizeTest, printsATableForPeople)
{
  write("table.pcd", table());
  const Call call = localize("table.pcd");
  EXPECT_EQ(call.status, 0);
  EXPECT_EQ(call.err, "");
  ASSERT_GT(lines(call.out).size(), 2U);
  EXPECT_EQ(lines(call.out)[0].find("table.pcd: "), 0U) << call.out;
  EXPECT_LE(lines(call.out).size(), 24U) << "short, however many shells there are";
  const Json json = localize("--json table.pcd").json().at(0);
  const std::string handles = std::to_string(json["handles"].size()) + " handles";
  EXPECT_NE(lines(call.out)[0].find(handles), std::string::npos) << call.out;
  EXPECT_EQ(lines(call.out)[2].find("   1 "), 0U) << "the best handle comes first\n" << call.out;
  const std::string shells = std::to_string(json["shells"].size()) + " shells";
  EXPECT_NE(lines(call.out).back().find(shells), std::string::npos) << call.out;
}

TEST_F(LocalizeTest, printsHelpAndVersion)
{
  const Call help = localize("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* option :
       {"--config", "--preset", "--samples", "--capture-radius", "--finger-thickness", "--min-length", "--neighborhood",
        "--estimator", "--threads", "--seed", "--topic", "--picture", "--json"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
  const Call version = localize("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.find("localize "), 0U);
  EXPECT_TRUE(std::isdigit(version.out[9])) << version.out;
}

TEST_F(LocalizeTest, saysWhenStdoutIsFull)
{
  write("table.pcd", table());
  EXPECT_EQ(run("(" LOCALIZE " --json --samples 10 table.pcd > /dev/full)"), 1);
  EXPECT_NE(content("stderr").find("cannot write to stdout"), std::string::npos);
}

}  // namespace
}  // namespace grasp_affordances
