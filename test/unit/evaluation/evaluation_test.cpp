#include "evaluation/evaluation.h"
#include "evaluation/close_up.h"
#include "evaluation/error_pictures.h"
#include "evaluation/judge.h"
#include "evaluation/recordings.h"
#include "evaluation/report.h"
#include "evaluation/statistics.h"
#include "evaluation/summary.h"
#include "rendering/picture_camera.h"
#include "support/points.h"
#include "support/test_with_folder.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Labels = std::vector<std::uint32_t>;

/// About the z axis: inner radius 2 cm, length 4 cm.
Shell makeShell()
{
  Shell shell;
  shell.inner_radius = 0.02;
  shell.thickness = 0.008;
  shell.length = 0.04;
  return shell;
}

/// Verdict on a shell that holds one point per label.
Verdict verdictOn(const Labels& labels)
{
  Points points;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    points.emplace_back(0.001 * static_cast<double>(i), 0.01, 0.0);
  }
  return judge(makeShell(), cloudOf(points), labels);
}

TEST(Judge, RightWhereAffordancesAreNoFewerThanTheRest)
{
  EXPECT_EQ(verdictOn({1, 0}).kind, Verdict::right);
  EXPECT_EQ(verdictOn({1, 0, 0}).kind, Verdict::wrong);
  EXPECT_EQ(verdictOn({1, 2, 0, 0}).kind, Verdict::right) << "affordances count together";
  EXPECT_EQ(verdictOn({1, 255, 255, 255}).kind, Verdict::right) << "doubtful ones do not count";
  EXPECT_EQ(verdictOn({}).kind, Verdict::wrong);
}

TEST(Judge, NotCountedWhereDoubtOutnumbersTheRest)
{
  EXPECT_EQ(verdictOn({255, 255, 0}).kind, Verdict::not_counted);
  EXPECT_EQ(verdictOn({255, 0}).kind, Verdict::wrong);
  EXPECT_EQ(verdictOn({1, 0, 0, 255, 255, 255}).kind, Verdict::not_counted);
}

TEST(Judge, FindsTheAffordanceWithMostPoints)
{
  EXPECT_EQ(verdictOn({3, 7, 7, 0}).affordance, 7U);
  EXPECT_EQ(verdictOn({7, 0, 0}).affordance, 0U) << "a wrong shell finds nothing";
}

TEST(Judge, LooksWithinTheLengthAndTwoMillimetresBeyondTheInnerRadius)
{
  const auto is_within = [](const Eigen::Vector3d& point) {
    return judge(makeShell(), cloudOf({point}), {1}).kind == Verdict::right;
  };
  EXPECT_TRUE(is_within({0.0219, 0.0, 0.0199}));
  EXPECT_FALSE(is_within({0.0221, 0.0, 0.0199}));
  EXPECT_FALSE(is_within({0.0219, 0.0, 0.0201}));
}

/// A bumpy wall before a pinhole camera, with holes.
Cloud makeOrganizedCloud(Random& random)
{
  const PinholeIntrinsics k{130.0, 130.0, 79.5, 59.5};
  Cloud cloud;
  cloud.reset(160, 120);
  cloud.intrinsics = k;
  for (std::uint32_t v = 0, i = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u, ++i) {
      const double z = random.uniform(0.0, 1.0) < 0.1 ? std::nan("") : random.uniform(0.6, 0.7);
      cloud.set(i, static_cast<float>((u - k.cx) / k.fx * z), static_cast<float>((v - k.cy) / k.fy * z),
                static_cast<float>(z));
    }
  }
  return cloud;
}

TEST(Judge, BoundedSearchOfAnOrganizedCloudAgreesWithLookingAtEachPoint)
{
  Random random(1);
  const Cloud cloud = makeOrganizedCloud(random);
  const Cloud points = unorganized(cloud);
  Labels labels(cloud.size());
  for (std::uint32_t& label : labels) {
    const double draw = random.uniform(0.0, 1.0);
    label = draw < 0.4 ? 0 : draw < 0.7 ? 255 : static_cast<std::uint32_t>(random.uniform(1.0, 4.0));
  }
  const Judge bounded(cloud, labels), brute(points, labels);
  int right = 0, wrong = 0, not_counted = 0;
  for (int i = 0; i < 1000; ++i) {
    Shell shell;
    shell.centroid = {random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), random.uniform(0.5, 0.8)};
    shell.axis = random.direction();
    shell.inner_radius = random.uniform(0.005, 0.03);
    shell.length = random.uniform(0.01, 0.1);
    const Verdict expected = brute(shell);
    const Verdict verdict = bounded(shell);
    ASSERT_EQ(verdict.kind, expected.kind) << i;
    ASSERT_EQ(verdict.affordance, expected.affordance) << i;
    right += verdict.kind == Verdict::right ? 1 : 0;
    wrong += verdict.kind == Verdict::wrong ? 1 : 0;
    not_counted += verdict.kind == Verdict::not_counted ? 1 : 0;
  }
  EXPECT_GT(right, 30);
  EXPECT_GT(wrong, 30);
  EXPECT_GT(not_counted, 20);
}

TEST(Judge, CountsThePointsOfAllViewsInTheFrameOfTheShell)
{
  Random random(3);
  const Cloud cloud = makeOrganizedCloud(random);
  const Labels graspable(cloud.size(), 1), other(cloud.size(), 0);
  Shell shell;
  shell.centroid = {0.1, 0.05, 0.65};
  shell.inner_radius = 0.03;
  shell.length = 0.1;
  const Eigen::Isometry3d T_first_second(Eigen::Translation3d(0.5, -0.2, 0.7) *
                                         Eigen::AngleAxisd(1.2, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  const Shell first = shell;
  shell.centroid = T_first_second * first.centroid;
  shell.axis = T_first_second.linear() * first.axis;
  const Cloud nothing;
  const Labels no_labels;
  Judge judge(nothing, no_labels);
  judge.addView(cloud, graspable, T_first_second);
  EXPECT_EQ(judge(shell).kind, Verdict::right);
  EXPECT_EQ(judge(first).kind, Verdict::wrong) << "no point of the view is there";
  judge.addView(cloud, other, T_first_second);
  EXPECT_EQ(judge(shell).kind, Verdict::right) << "as many as others";
  judge.addView(cloud, other, T_first_second);
  EXPECT_EQ(judge(shell).kind, Verdict::wrong);
}

TEST(LabelledCloud, UnitedViewsAreInTheFrameOfTheFirst)
{
  LabelledCloud labelled;
  labelled.cloud.reset(2, 1);
  labelled.cloud.set(1, 0.1F, 0.2F, 0.9F);
  labelled.labels = {7, 1};
  labelled.further_views = {{cloudOf({{0.0, 0.0, 1.0}}), Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 0.0)), {2}},
                            {cloudOf({{0.0, 0.0, 2.0}}), Eigen::Isometry3d::Identity(), {3}}};
  const LabelledCloud two = united(labelled, 2);
  EXPECT_EQ(two.labels, (Labels{1, 2})) << "what is not measured is left out";
  EXPECT_TRUE(two.cloud.point(1).isApprox(Eigen::Vector3f(0.5F, 0.0F, 1.0F)));
  EXPECT_EQ(united(labelled, 3).labels, (Labels{1, 2, 3}));
}

TEST(Statistics, MeanHasTheIntervalOfStudentsT)
{
  const Mean result = mean({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(result.value, 2.0);
  EXPECT_NEAR(result.interval.high - 2.0, 4.30265 / std::sqrt(3.0), 1e-5);  // t table, 2 degrees of freedom
  EXPECT_NEAR(2.0 - result.interval.low, 4.30265 / std::sqrt(3.0), 1e-5);
  EXPECT_TRUE(std::isnan(mean({1.0}).interval.low));
  EXPECT_TRUE(std::isnan(mean({}).value));
}

TEST(Statistics, MeanShareLeavesOutUnitsWithoutShells)
{
  const Mean result = meanShare({{1, 2}, {0, 0}, {4, 4}});
  EXPECT_DOUBLE_EQ(result.value, 0.75);
  EXPECT_EQ(result.count, 2U);
  EXPECT_DOUBLE_EQ(result.interval.low, 0.0) << "cut off";
  EXPECT_DOUBLE_EQ(result.interval.high, 1.0) << "cut off";
}

TEST(Statistics, PooledIntervalIsThatOfABinomialForUnitsOfOne)
{
  std::vector<Ratio> units(400, Ratio{1, 1});
  std::fill(units.begin(), units.begin() + 80, Ratio{0, 1});
  const Interval interval = pooledInterval(units);
  const double half = 1.96 * std::sqrt(0.8 * 0.2 / 400.0);
  // A quantile of 2000 draws is known to 0.04 of the interval, and shares come in steps of 1/400.
  EXPECT_NEAR(interval.low, 0.8 - half, 0.004);
  EXPECT_NEAR(interval.high, 0.8 + half, 0.004);
}

TEST(Statistics, PooledIntervalIsWiderWhereUnitsHoldMore)
{
  // The same 80 % as 20 units that are all right and 5 that are all wrong.
  std::vector<Ratio> units(25, Ratio{16, 16});
  std::fill(units.begin(), units.begin() + 5, Ratio{0, 16});
  const Interval interval = pooledInterval(units);
  EXPECT_LT(interval.low, 0.68);
  EXPECT_GT(interval.high, 0.92);
  EXPECT_TRUE(std::isnan(pooledInterval({{1, 2}}).low));
  EXPECT_TRUE(std::isnan(pooledInterval({{0, 0}, {0, 0}}).low));
}

TEST(Statistics, PairedDifferenceNeedsBothShares)
{
  const Mean result = pairedDifference({{4, 4}, {1, 1}, {3, 4}}, {{2, 4}, {0, 0}, {2, 4}});
  EXPECT_EQ(result.count, 2U);
  EXPECT_DOUBLE_EQ(result.value, 0.375);
}

JudgedShell judged(Verdict::Kind kind, std::uint32_t affordance = 0, double x = 0.0)
{
  Shell shell = makeShell();
  shell.centroid.x() = x;
  return {shell, {kind, affordance}};
}

Affordance makeAffordance(std::uint32_t label, std::size_t visible_points, double occluded_share)
{
  Affordance affordance;
  affordance.label = label;
  affordance.object = "object " + std::to_string(label);
  affordance.visible_points = visible_points;
  affordance.occluded_share = occluded_share;
  return affordance;
}

FrameResult makeFrame(const std::string& scene, std::uint64_t seed)
{
  FrameResult frame;
  frame.group = "paper";
  frame.scene = scene;
  frame.seed = seed;
  frame.points = 1000;
  return frame;
}

/// Taubin and PCA, each with two runs on two frames of one scene.
Evaluation makeEvaluation()
{
  Evaluation evaluation;
  evaluation.runs = 2;
  evaluation.variations.resize(2);
  evaluation.variations[1].config.estimation.estimator = Estimator::pca;
  FrameResult first = makeFrame("mugs", 1);
  first.affordances = {makeAffordance(1, 900, 0.1), makeAffordance(2, 100, 0.9)};
  first.runs = {{{{judged(Verdict::right, 1), judged(Verdict::right, 2), judged(Verdict::not_counted)}, 10},
                 {{judged(Verdict::right, 1), judged(Verdict::wrong, 0, 0.5)}, 10}},
                {{{}, 10}, {{judged(Verdict::right, 1), judged(Verdict::wrong)}, 10}}};
  FrameResult second = makeFrame("mugs", 2);
  second.affordances = {makeAffordance(1, 300, 0.6)};
  second.runs = {{{{}, 10}, {{}, 10}}, {{{}, 10}, {{}, 10}}};
  evaluation.frames = {first, second};
  return evaluation;
}

TEST(Summary, PoolsPrecisionAndRecallOverRuns)
{
  const std::vector<SummaryRow> rows = summarize(makeEvaluation());
  ASSERT_EQ(rows.size(), 2U) << "a group of one scene has no row of its own";
  const Score& s = rows[0].score;
  EXPECT_EQ(s.precision.part, 3U);
  EXPECT_EQ(s.precision.whole, 4U);
  EXPECT_EQ(s.not_counted, 1U);
  EXPECT_DOUBLE_EQ(s.wrongPerRun(), 0.25);
  EXPECT_DOUBLE_EQ(s.unit_precision.value, 0.75) << "the frame without shells is left out";
  EXPECT_EQ(s.unit_precision.count, 1U);
  const auto recall = [&](const char* key) {
    for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
      if (std::string(kVisibilityClasses[i].key) == key) {
        return s.recall[i];
      }
    }
    throw std::invalid_argument(key);
  };
  EXPECT_EQ(recall("all").found.part, 3U);
  EXPECT_EQ(recall("all").found.whole, 6U);
  EXPECT_DOUBLE_EQ(recall("800").found.value(), 1.0);
  EXPECT_DOUBLE_EQ(recall("200").found.value(), 0.5);
  EXPECT_DOUBLE_EQ(recall("200_clear").found.value(), 1.0);
  EXPECT_DOUBLE_EQ(recall("below_800").found.value(), 0.25);
  EXPECT_NEAR(recall("below_800").chance, (1.0 - std::pow(0.9, 10) + 1.0 - std::pow(0.7, 10)) / 2, 1e-12);
}

TEST(Summary, CountsByWhatTheFirstViewAndTheOthersShow)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.variations[1] = {evaluation.variations[0].config, 2};
  FrameResult& frame = evaluation.frames[0];
  frame.affordances.push_back(makeAffordance(3, 0, 1.0));
  frame.further_views = {{3000, {0, 50, 400}}, {1000, {0, 300, 0}}};
  frame.runs[1][0].shells = {judged(Verdict::right, 3)};
  evaluation.frames.resize(1);
  EXPECT_EQ(pointsIn(frame, 2), 4000U);
  EXPECT_EQ(visiblePoints(frame, 1, 3), 450U);
  EXPECT_EQ(visibleElsewhere(frame, 1), 300U);
  const std::vector<SummaryRow> rows = summarize(evaluation);
  EXPECT_FALSE(rows[1].taubin_difference);
  const auto& one = rows[0].score.recall;
  const auto& two = rows[1].score.recall;
  EXPECT_EQ(one[0].found.whole, 4U) << "what the first view does not show counts in no class but those of other views";
  ASSERT_EQ(kVisibilityClasses[5].key, std::string("hidden"));
  ASSERT_EQ(kVisibilityClasses[6].key, std::string("hardly_seen"));
  EXPECT_EQ(one[5].found.part, 0U);
  EXPECT_EQ(two[5].found.part, 1U);
  EXPECT_EQ(two[5].found.whole, 2U);
  EXPECT_EQ(two[6].found.whole, 4U);
  EXPECT_NEAR(two[5].chance, 1.0 - std::pow(0.9, 10), 1e-12);
}

TEST(Summary, ComparesWithTaubinUnitByUnit)
{
  const std::vector<SummaryRow> rows = summarize(makeEvaluation());
  EXPECT_FALSE(rows[0].taubin_difference);
  ASSERT_TRUE(rows[1].taubin_difference);
  EXPECT_EQ(rows[1].taubin_difference->count, 1U);
  EXPECT_DOUBLE_EQ(rows[1].taubin_difference->value, 0.25);
}

TEST(Summary, RunsOfASingleFrameAreItsUnits)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.frames.resize(1);
  const Score score = summarize(evaluation)[0].score;
  EXPECT_EQ(score.unit_precision.count, 2U);
  EXPECT_DOUBLE_EQ(score.unit_precision.value, 0.75);
}

TEST(Summary, GroupsOfSeveralScenesArePooled)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.frames[1].scene = "luggage";
  const std::vector<SummaryRow> rows = summarize(evaluation);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_TRUE(rows[4].is_group);
  EXPECT_EQ(rows[4].scene, "paper");
  EXPECT_EQ(rows[4].score.frames, 2U);
}

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

/// A bar before nothing.
EvaluationFrame barFrame(std::uint64_t seed)
{
  return {"", "bar", seed, [seed] {
            Random random(seed);
            LabelledCloud labelled;
            labelled.cloud = cloudOf(transformed(cylinderPoints(0.012, 2.5, 0.1, 2000, random),
                                                 Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.8}));
            labelled.labels.assign(labelled.cloud.size(), 1);
            labelled.affordances = {makeAffordance(1, 2000, 0.0), makeAffordance(2, 0, 1.0)};
            labelled.capture_radius = 0.026;
            return labelled;
          }};
}

Config fewSamples()
{
  Config config = presetConfig("paper");
  config.sampling.samples = 50;
  return config;
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
