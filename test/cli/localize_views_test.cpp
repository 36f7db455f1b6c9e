#include "cli/command_line_test.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

/// `localize --view` on clouds that `simulate` wrote.
class LocalizeViewsTest : public test::CommandLineTest
{
protected:
  /// The table by a turned camera, with its pose in the table's frame as VIEWPOINT and in NAME.json.
  void simulate(const std::string& name, int turn_degrees) const
  {
    ASSERT_EQ(run(SIMULATE " --scene table --turn " + std::to_string(turn_degrees) + " --noise-seed " +
                  std::to_string(turn_degrees) + " --out " + name + " --objects " + name + ".json"),
              0)
        << content("stderr");
  }

  Json localize(const std::string& arguments) const
  {
    EXPECT_EQ(run(LOCALIZE " --json --samples 2000 " + arguments), 0) << arguments;
    EXPECT_EQ(content("stderr"), "") << arguments;
    return Json::parse(content("stdout"));
  }

  /// x,y,z,qx,qy,qz,qw of the camera in the table's frame.
  std::string pose(const std::string& name) const
  {
    const Json camera = Json::parse(content(name + ".json"))["camera"];
    std::string text;
    for (const char* key : {"position", "orientation"}) {
      for (const Json& value : camera[key]) {
        text += (text.empty() ? "" : ",") + value.dump();
      }
    }
    return text;
  }
};

Eigen::Vector3d vector(const Json& json)
{
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Eigen::Isometry3d transform(const Json& view)
{
  const Json& q = view["rotation"];
  return Eigen::Translation3d(vector(view["translation"])) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
}

TEST_F(LocalizeViewsTest, readsThePoseFromTheViewpointWithQwFirst)
{
  simulate("a.pcd", 0);
  const Json from_viewpoint = localize("--view a.pcd");
  const Json given = localize("--view a.pcd:" + pose("a.pcd"));
  ASSERT_EQ(from_viewpoint["views"].size(), 1U);
  const Eigen::Isometry3d expected = transform(given["views"][0]);
  EXPECT_TRUE(transform(from_viewpoint["views"][0]).isApprox(expected, 1e-5));
  EXPECT_LT((expected.translation() - vector(Json::parse(content("a.pcd.json"))["camera"]["position"])).norm(), 1e-9);
  EXPECT_LT(expected.linear().col(2).z(), -0.3) << "the camera looks down at the table";
}

TEST_F(LocalizeViewsTest, aSingleViewGivesWhatTheCloudGivesInTheCommonFrame)
{
  simulate("a.pcd", 0);
  const Json alone = localize("a.pcd");
  const Json view = localize("--view a.pcd");
  EXPECT_EQ(alone.count("views"), 0U);
  EXPECT_EQ(view["file"], "a.pcd");
  EXPECT_EQ(view["points"], alone["points"]);
  EXPECT_EQ(view["views"][0]["points"], alone["points"]);
  EXPECT_TRUE(view["view_disagreement"].is_null());
  EXPECT_EQ(view["counts"], alone["counts"]);
  ASSERT_EQ(view["shells"].size(), alone["shells"].size());
  ASSERT_FALSE(view["shells"].empty());
  const Eigen::Isometry3d T_common_cloud = transform(view["views"][0]);
  for (std::size_t i = 0; i < view["shells"].size(); ++i) {
    const Json& shell = view["shells"][i];
    const Json& expected = alone["shells"][i];
    EXPECT_LT((vector(shell["centroid"]) - T_common_cloud * vector(expected["centroid"])).norm(), 1e-6);
    EXPECT_LT((vector(shell["normal"]) - T_common_cloud.linear() * vector(expected["normal"])).norm(), 1e-6);
    EXPECT_NEAR(std::abs(vector(shell["axis"]).dot(T_common_cloud.linear() * vector(expected["axis"]))), 1.0, 1e-9);
    EXPECT_EQ(shell["point_index"], expected["point_index"]);
    EXPECT_EQ(shell["inner_radius"], expected["inner_radius"]);
  }
}

/// Shells of both views lie where one of the views alone finds shells, but for the few that only both together show.
TEST_F(LocalizeViewsTest, twoViewsAreOneCloudInTheCommonFrame)
{
  simulate("a.pcd", 0);
  simulate("b.pcd", 60);
  const Json both = localize("--view a.pcd --view b.pcd");
  const Json a = localize("--view a.pcd"), b = localize("--view b.pcd");
  EXPECT_EQ(both["file"], "a.pcd");
  ASSERT_EQ(both["views"].size(), 2U);
  EXPECT_EQ(both["views"][1]["file"], "b.pcd");
  EXPECT_EQ(both["points"], a["points"].get<int>() + b["points"].get<int>());
  EXPECT_EQ(both["views"][1]["first_point_index"], 640 * 480);

  std::size_t near = 0, of_second = 0;
  for (const Json& shell : both["shells"]) {
    const auto beside = [&](const Json& other) {
      return (vector(other["centroid"]) - vector(shell["centroid"])).norm() < 0.03;
    };
    near += std::any_of(a["shells"].begin(), a["shells"].end(), beside) ||
            std::any_of(b["shells"].begin(), b["shells"].end(), beside);
    of_second += shell["point_index"].get<int>() >= 640 * 480;
  }
  EXPECT_GT(both["shells"].size(), 20U);
  EXPECT_GT(near, 0.9 * both["shells"].size());
  EXPECT_GT(of_second, 0U);
  EXPECT_LT(of_second, both["shells"].size());
}

TEST_F(LocalizeViewsTest, fileNamesMayHoldColons)
{
  simulate("a.pcd", 0);
  std::filesystem::copy_file(path("a.pcd"), path("at 12:30.pcd"));
  EXPECT_EQ(localize("--view 'at 12:30.pcd'")["file"], "at 12:30.pcd");
  const Json posed = localize("--view 'at 12:30.pcd:1,-2,0.5,0,0,0.6,0.8'");
  EXPECT_EQ(posed["file"], "at 12:30.pcd");
  EXPECT_EQ(posed["views"][0]["translation"], Json({1.0, -2.0, 0.5}));
  EXPECT_EQ(posed["views"][0]["rotation"].size(), 4U);
  EXPECT_NEAR(posed["views"][0]["rotation"][2], 0.6, 1e-12);
  EXPECT_NEAR(posed["views"][0]["rotation"][3], 0.8, 1e-12);
}

TEST_F(LocalizeViewsTest, drawsAllViews)
{
  simulate("a.pcd", 0);
  simulate("b.pcd", 60);
  localize("--view a.pcd --view b.pcd --picture both.png");
  localize("--view a.pcd --picture one.png");
  EXPECT_EQ(content("both.png").find("PNG"), 1U);
  EXPECT_NE(content("both.png"), content("one.png"));
}

TEST_F(LocalizeViewsTest, refusesMalformedPosesAndMixedInputs)
{
  const std::vector<std::pair<std::string, std::string>> cases{
      {"--view a.pcd:0,0,0", "seven numbers"},
      {"--view a.pcd:0,0,0,0,0,0,1,0", "seven numbers"},
      {"--view a.pcd:0,0,0,0,0,0,one", "seven numbers"},
      {"--view a.pcd:0,0,0,0,0,0,1,", "seven numbers"},
      {"--view a.pcd:0,0,0,0,0,0,0", "unit length"},
      {"--view a.pcd:0,0,0,0,0,0,1.002", "unit length"},
      {"--view a.pcd:0,0,0,1,0,0,1", "unit length"},
      {"--view a.pcd b.pcd", "b.pcd"},
      {"b.pcd --view a.pcd", "b.pcd"},
      {"--view", "--view"},
  };
  for (const auto& [arguments, reason] : cases) {
    SCOPED_TRACE(arguments);
    EXPECT_EQ(run(LOCALIZE " --json " + arguments), 2);
    EXPECT_EQ(content("stdout"), "");
    const std::string error = content("stderr");
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    EXPECT_NE(error.find(reason), std::string::npos) << error;
  }
}

TEST_F(LocalizeViewsTest, namesTheViewThatItCannotRead)
{
  simulate("a.pcd", 0);
  std::ofstream(path("no_pose.pcd")) << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\n"
                                        "HEIGHT 1\nVIEWPOINT 0 0 0 0 0 0 0\nPOINTS 1\nDATA ascii\n0 0 1\n";
  for (const auto& [view, reason] :
       {std::make_pair("missing.pcd", "missing.pcd: No such file"), std::make_pair("no_pose.pcd", "VIEWPOINT")}) {
    SCOPED_TRACE(view);
    EXPECT_EQ(run(std::string(LOCALIZE " --json --view a.pcd --view ") + view), 1);
    EXPECT_EQ(content("stdout"), "");
    EXPECT_EQ(content("stderr").find(std::string(view) + ": "), 0U) << content("stderr");
    EXPECT_NE(content("stderr").find(reason), std::string::npos) << content("stderr");
  }
}

}  // namespace
}  // namespace grasp_affordances
