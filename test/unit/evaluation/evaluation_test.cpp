#include "evaluation/evaluation.h"
#include "evaluation/close_up.h"
#include "evaluation/error_pictures.h"
#include "evaluation/recordings.h"
#include "evaluation/report.h"
#include "evaluation/summary.h"
#include "rendering/picture_camera.h"
#include "support/evaluations.h"
#include "support/points.h"
#include "support/test_with_folder.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(ErrorPictures, ShellsAtOnePlaceAreOneErrorAndTheWorstComeFirst)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.frames[0].capture_radius = 0.026;
  auto& shells = evaluation.frames[0].runs[0][1].shells;
  shells = {judged(Verdict::wrong, 0, 0.5), judged(Verdict::wrong, 0, 0.8), judged(Verdict::wrong, 0, 0.81)};
  std::vector<Error> errors = worstErrors(evaluation, 1);
  errors.erase(
      std::remove_if(errors.begin(), errors.end(),
                     [](const Error& error) { return error.variation != 0 || error.kind == Error::no_handle; }),
      errors.end());
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0].kind, Error::wrong_shell);
  EXPECT_EQ(errors[0].index, 1U);
  EXPECT_EQ(errors[0].run, 1U);
  EXPECT_EQ(errors[0].count, 2U);
  EXPECT_EQ(errors[1].kind, Error::miss);
  EXPECT_EQ(errors[1].label, 1U) << "900 points, missed in the second run";
  EXPECT_EQ(errors[1].count, 1U);
}

TEST(CloseUp, OfAnOrganizedCloudIsWhatASensorMeasured)
{
  Random random(2);
  const Cloud cloud = makeOrganizedCloud(random);
  const auto colors = labelColors(Labels(cloud.size(), 0));
  const Eigen::Vector3d center(0.1, 0.05, 0.65);
  const ColoredCloud view = closeUp(cloud, colors, center, 0.1);
  EXPECT_TRUE(pictureCamera(view.cloud).is_sensor);
  EXPECT_LT(view.cloud.size(), cloud.size() / 4);
  EXPECT_EQ(view.colors.size(), view.cloud.size());
  const auto within = [&](const Cloud& points) {
    return bruteForceNeighborhood(points, center.cast<float>(), 0.1F).size();
  };
  EXPECT_EQ(within(view.cloud), within(cloud));
  EXPECT_EQ(within(closeUp(unorganized(cloud), colors, center, 0.1).cloud), within(cloud));
}

TEST(CloseUp, OfARangeImageWithABadPointIsWhatASensorMeasured)
{
  Random random(2);
  Cloud cloud = makeOrganizedCloud(random);
  cloud.set(0, 1.0F, 1.0F, -1.0F);
  const ColoredCloud view = closeUp(cloud, labelColors(Labels(cloud.size(), 0)), Eigen::Vector3d(0.1, 0.05, 0.65), 0.1);
  EXPECT_GT(view.cloud.height, 1U);
  EXPECT_TRUE(pictureCamera(view.cloud).is_sensor);
}

TEST(CloseUp, CrossSectionLooksAlongTheAxisWithTheSensorAbove)
{
  const Eigen::Vector3d middle(0.1, 0.2, 0.9);
  Shell shell = makeShell();
  shell.centroid = middle;
  shell.axis = Eigen::Vector3d::UnitX();
  shell.normal = -Eigen::Vector3d::UnitZ();
  const Cloud cloud = cloudOf({middle + Eigen::Vector3d(0.01, 0.0, -0.015), middle + Eigen::Vector3d(0.03, 0.0, 0.0),
                               middle + Eigen::Vector3d(0.0, 0.2, 0.0)});
  const ColoredCloud section = crossSection(cloud, labelColors({1, 0, 0}), shell);
  ASSERT_EQ(section.cloud.size(), 1U) << "one beyond the length, one far beside";
  EXPECT_TRUE(section.cloud.point(0).isApprox(Eigen::Vector3f(0.0F, -0.015F, 2.01F), 1e-5F));
  EXPECT_TRUE(shell.centroid.isApprox(Eigen::Vector3d(0.0, 0.0, 2.0)));
  EXPECT_TRUE(shell.normal.isApprox(-Eigen::Vector3d::UnitY()));
}

TEST(CloseUp, CrossSectionOfAShellWithoutANormalIsSeenFromAnySide)
{
  const Eigen::Vector3d middle(0.1, 0.2, 0.9);
  Shell shell = makeShell();
  shell.centroid = middle;
  shell.axis = Eigen::Vector3d::UnitX();
  shell.normal.setConstant(std::nan(""));
  const Cloud cloud = cloudOf({middle + Eigen::Vector3d(0.01, 0.0, -0.015)});
  const ColoredCloud section = crossSection(cloud, labelColors({1}), shell);
  ASSERT_EQ(section.cloud.size(), 1U);
  EXPECT_NEAR(section.cloud.point(0).head<2>().norm(), 0.015F, 1e-5F);
  EXPECT_TRUE(shell.normal.isApprox(-Eigen::Vector3d::UnitY()));
}

TEST(Evaluate, ThreadsHaveNoInfluence)
{
  const std::vector<EvaluationFrame> frames{barFrame(1), barFrame(2), barFrame(3)};
  std::vector<std::string> tables;
  for (const std::size_t threads : {1, 3}) {
    std::size_t done = 0;
    Evaluation evaluation{{{fewSamples()}}, 2, {}};
    evaluation.frames = evaluate(frames, evaluation.variations, 2, threads, [&] { ++done; });
    EXPECT_EQ(done, 3U);
    ASSERT_EQ(evaluation.frames.size(), 3U);
    EXPECT_EQ(evaluation.frames[2].seed, 3U);
    EXPECT_EQ(evaluation.frames[0].affordances.size(), 1U) << "one that the frame does not show is left out";
    EXPECT_TRUE(finds(evaluation.frames[0].runs[0][0], 1));
    EXPECT_FALSE(finds(evaluation.frames[0].runs[0][0], 2));
    tables.push_back(markdownTables(evaluation, summarize(evaluation)));
  }
  EXPECT_EQ(tables[0], tables[1]);
}

TEST(Evaluate, FailsWithTheFrameThatCannotBeLoaded)
{
  std::vector<EvaluationFrame> frames{barFrame(1), barFrame(2)};
  frames[1].load = []() -> LabelledCloud { throw std::runtime_error("no such cloud"); };
  EXPECT_THROW(evaluate(frames, {{fewSamples()}}, 1, 2, [] {}), std::runtime_error);
}

class EvaluationFiles : public TestWithFolder
{
protected:
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  std::vector<std::string> lines(const std::string& name) const
  {
    std::ifstream file(folder_ / name);
    std::vector<std::string> result;
    for (std::string line; std::getline(file, line);) {
      result.push_back(line);
    }
    return result;
  }
};

TEST_F(EvaluationFiles, ReportHasARowPerShellAndPerAffordance)
{
  const Evaluation evaluation = makeEvaluation();
  writeReport(folder_, evaluation, summarize(evaluation));
  const auto shells = lines("shells.csv");
  ASSERT_EQ(shells.size(), 1U + 7U);
  EXPECT_EQ(shells[2].substr(0, 36), "mugs,1,1,localizer,taubin,1,1,right,");
  const auto affordances = lines("affordances.csv");
  ASSERT_EQ(affordances.size(), 1U + 2U * 3U);
  EXPECT_EQ(affordances[1].substr(0, 55), "mugs,1,localizer,taubin,1,1,object 1,900,0,0.1,0,0,0,2,");
  EXPECT_EQ(lines("summary.csv").size(), 1U + 2U);
  EXPECT_EQ(lines("table.md").size(), 2U * (2U * 5U + 1U) + 1U) << "shells and handles, two variations each";
  for (const std::string& line : lines("summary.csv")) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 19 + 4 * 8 + 2 + 13 + 4 * 8) << line;
  }
}

TEST_F(EvaluationFiles, ReportThatCannotBeWrittenIsAnError)
{
  const Evaluation evaluation = makeEvaluation();
  EXPECT_THROW(writeReport(folder_ / "absent", evaluation, summarize(evaluation)), std::runtime_error);
}

TEST_F(EvaluationFiles, ErrorsAreDrawnUnderTheirNames)
{
  const std::vector<EvaluationFrame> frames{barFrame(1)};
  Evaluation evaluation{{{fewSamples()}}, 1, {}};
  evaluation.frames = evaluate(frames, evaluation.variations, 1, 1, [] {});
  auto& shells = evaluation.frames[0].runs[0][0].shells;
  ASSERT_FALSE(shells.empty());
  for (JudgedShell& each : shells) {
    each.verdict = {Verdict::wrong, 0};
  }
  drawErrors(folder_, evaluation, frames, worstErrors(evaluation, 1), 1, [] {});
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder_)) {
    names.push_back(file.path().filename());
  }
  std::sort(names.begin(), names.end());
  ASSERT_EQ(names.size(), 3U);
  EXPECT_EQ(names[0], "bar-1-paper-taubin-miss-1-1.png");
  EXPECT_EQ(names[1].substr(0, 25), "bar-1-paper-taubin-wrong-");
}

TEST_F(EvaluationFiles, RecordingsGetTheLabelsOfTheirGroups)
{
  pcl::PointCloud<pcl::PointXYZL> cloud;
  for (const std::uint32_t object : {20U, 30U, 31U, 50U, 7U}) {
    pcl::PointXYZL point;
    point.x = point.y = point.z = 1.0F;
    point.label = object;
    cloud.push_back(point);
  }
  pcl::PCDWriter().writeBinary(folder_ / "desk.pcd", cloud);
  const std::string path = write("labels.json", R"({"capture_radius": 0.04, "scenes":
      {"desk": {"affordances": [[20], [30, 31]], "ignore": [50]}}})");
  const auto frames = recordedFrames(path);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].scene, "desk");
  const LabelledCloud labelled = frames[0].load();
  EXPECT_EQ(labelled.labels, (Labels{1, 2, 2, 255, 0}));
  EXPECT_DOUBLE_EQ(labelled.capture_radius, 0.04);
  ASSERT_EQ(labelled.affordances.size(), 2U);
  EXPECT_EQ(labelled.affordances[1].visible_points, 2U);
}

TEST_F(EvaluationFiles, RecordingsThatCannotBeReadAreErrorsWithThePath)
{
  const auto reason = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  const auto of_file = [&](const std::string& path) { return reason([&] { recordedFrames(path); }); };
  EXPECT_NE(of_file(folder_ / "absent.json").find("absent.json: cannot be read"), std::string::npos);
  for (const char* text : {"", R"({"scenes": {})", R"({"scenes": {"a": {}}, "capture_radius": 1})",
                           R"({"scenes": {"a": {"affordances": [], "ignore": []}}})",
                           R"({"scenes": {"a": {"affordances": [[-]], "ignore": []}}, "capture_radius": 1})"}) {
    EXPECT_EQ(of_file(write("bad.json", text)).find((folder_ / "bad.json").string() + ": "), 0U) << text;
  }
  const auto of_scene = [&](const std::string& name, const std::string& scene, const std::string& radius = "0.04") {
    return of_file(
        write("bad.json", R"({"scenes": {")" + name + "\": " + scene + R"(}, "capture_radius": )" + radius + "}"));
  };
  const std::string good = R"({"affordances": [[1]], "ignore": [4294967295]})";
  EXPECT_EQ(of_scene("a", good), "nothing thrown");
  for (const std::string object : {"-1", "1.5", "1e300", "4294967296", "null", "\"1\"", "[1]"}) {
    const std::string grasped = R"({"affordances": [[)" + object + R"(]], "ignore": []})";
    const std::string ignored = R"({"affordances": [], "ignore": [)" + object + "]}";
    EXPECT_NE(of_scene("a", grasped).find("is no label of an object"), std::string::npos) << object;
    EXPECT_NE(of_scene("a", ignored).find("is no label of an object"), std::string::npos) << object;
  }
  EXPECT_NE(of_scene("a", R"({"affordances": 5, "ignore": []})").find("5 is no list"), std::string::npos);
  EXPECT_NE(of_scene("a", R"({"affordances": [], "ignore": null})").find("null is no list"), std::string::npos);
  for (const char* name : {"", "../a", "/etc/a", "a/b", "a\\nb"}) {
    EXPECT_NE(of_scene(name, good).find("is no name of a scene"), std::string::npos) << name;
  }
  for (const char* radius : {"0", "-1", "null"}) {
    EXPECT_NE(of_scene("a", good, radius).find("bad.json: "), std::string::npos) << radius;
    EXPECT_NE(of_scene("a", good, radius), "nothing thrown") << radius;
  }
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  EXPECT_NE(of_scene("a", "{\"affordances\": [" + deep + "], \"ignore\": []}").find("array is no label"),
            std::string::npos);
  const std::string long_reason = of_file(write("bad.json", "\"" + std::string(100000, 'x')));
  EXPECT_LT(long_reason.size(), 1000U);
  const std::string path = write("labels.json", R"({"capture_radius": 0.04, "scenes":
      {"absent": {"affordances": [], "ignore": []}, "plain": {"affordances": [], "ignore": []}}})");
  pcl::PointCloud<pcl::PointXYZ> plain;
  plain.push_back({1.0F, 1.0F, 1.0F});
  pcl::PCDWriter().writeBinary(folder_ / "plain.pcd", plain);
  const auto frames = recordedFrames(path);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_NE(reason(frames[0].load).find("absent.pcd: "), std::string::npos);
  EXPECT_NE(reason(frames[1].load).find("plain.pcd: no field label"), std::string::npos);
}

}  // namespace
}  // namespace grasp_affordances::test
