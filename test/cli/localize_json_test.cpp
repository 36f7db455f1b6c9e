#include "cli/localize_calls.h"
#include "io/pcd.h"
#include "support/recordings.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

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
  const Call call = localize("--json --samples 2000 --viewpoint 0,0,0 unorganized.pcd");
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

}  // namespace
}  // namespace grasp_affordances
