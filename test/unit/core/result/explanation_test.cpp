#include "grasp_affordances/localizer.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// A result whose samples ended there, and what is said of it.
Localization endedIn(Outcome outcome, std::uint32_t count = 3900, std::uint32_t sampled = 4000)
{
  Localization result;
  result.points = 200000;
  result.sampled = sampled;
  result.counts[static_cast<std::size_t>(outcome)] = count;
  const Outcome other = outcome == Outcome::degenerate ? Outcome::concave : Outcome::degenerate;
  result.counts[static_cast<std::size_t>(other)] += sampled - count;
  return result;
}

/// One sentence that holds all these parts.
void expectSentence(const std::string& text, const std::vector<std::string>& parts)
{
  EXPECT_EQ(text.rfind("No handle: ", 0), 0U) << text;
  EXPECT_EQ(text.back(), '.') << text;
  EXPECT_EQ(text.find(". "), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  }
}

TEST(Explanation, IsEmptyWhereThereIsAHandle)
{
  Localization result = endedIn(Outcome::low_curvature);
  result.handles.resize(1);
  EXPECT_EQ(explainNothing(result, Config()), "");
}

TEST(Explanation, NamesTheDominatingOutcomeAndItsParameter)
{
  Config config;
  config.sampling.time_budget_ms = 5.0;
  const std::pair<Outcome, std::vector<std::string>> cases[] = {
      {Outcome::too_few_points, {"neighborhood/min_points = 10", "neighborhood/radius"}},
      {Outcome::degenerate, {"flat", "noise"}},
      {Outcome::occluded, {"occlusion/max_points_in_front (100)"}},
      {Outcome::low_curvature, {"26 mm", "hand/capture_radius"}},
      {Outcome::concave, {"estimation/reject_concave"}},
      {Outcome::no_shell, {"26 mm", "8 mm", "hand/capture_radius", "hand/finger_thickness"}},
      {Outcome::too_short, {"30 mm", "shell/min_length"}},
      {Outcome::unobserved_gap, {"0.25", "shell/min_observed_free"}},
      {Outcome::uncovered, {"0.7", "shell/min_coverage"}},
      {Outcome::out_of_time, {"sampling/time_budget_ms (5 ms)", "sampling/samples"}}};
  ASSERT_EQ(std::size(cases), kOutcomes - 1);
  for (const auto& [outcome, parts] : cases) {
    const std::string text = explainNothing(endedIn(outcome), config);
    expectSentence(text, parts);
    expectSentence(text, {"of 4000 samples 3900 ended", std::string("(") + outcomeName(outcome) + ")"});
  }
}

/// A table in the frame of a robot's base, which stands opposite and was taken for the sensor.
TEST(Explanation, DoesNotBlameFlatnessForWhatEndedAsConcave)
{
  Localization result = endedIn(Outcome::low_curvature, 1948, 1962);
  result.sampled = 2000;
  result.counts[static_cast<std::size_t>(Outcome::concave)] = 33;
  result.counts[static_cast<std::size_t>(Outcome::no_shell)] = 5;
  const std::string text = explainNothing(result, Config());
  expectSentence(text, {"of 2000 samples 33 ended", "(concave)", "the sensor's place", "estimation/reject_concave"});
  EXPECT_EQ(text.find("flatter"), std::string::npos) << text;
}

/// Before a table most samples are flat, whatever stands on it.
TEST(Explanation, LooksAtHowTheSamplesEndedThatWereNotFlat)
{
  Localization result;
  result.sampled = 2000;
  const auto set = [&](Outcome outcome, std::uint32_t count) {
    result.counts[static_cast<std::size_t>(outcome)] = count;
  };
  set(Outcome::low_curvature, 1900);
  set(Outcome::degenerate, 30);
  set(Outcome::no_shell, 50);
  set(Outcome::too_short, 20);
  const std::string text = explainNothing(result, Config());
  expectSentence(text, {"of 2000 samples 50 ended where no radius", "(no_shell)", "1930 others are on flat surfaces"});
  EXPECT_EQ(text.find("flatter"), std::string::npos) << text;

  // A hundredth of the samples may be noise.
  set(Outcome::low_curvature, 1950);
  set(Outcome::no_shell, 20);
  set(Outcome::too_short, 0);
  expectSentence(explainNothing(result, Config()), {"of 2000 samples 1950 ended", "(low_curvature)"});
}

/// The centroids of cells of a voxel grid.
Cloud voxelGrid(const Cloud& cloud, double size)
{
  std::map<std::array<int, 3>, std::pair<Eigen::Vector3d, int>> cells;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      const Eigen::Vector3d point = cloud.point(i).cast<double>();
      const Eigen::Array3i cell = (point / size).array().floor().cast<int>();
      auto& [sum, count] =
          cells.emplace(std::array<int, 3>{cell[0], cell[1], cell[2]}, std::make_pair(Eigen::Vector3d::Zero(), 0))
              .first->second;
      sum += point;
      ++count;
    }
  }
  Points points;
  for (const auto& [cell, sum] : cells) {
    points.push_back(sum.first / sum.second);
  }
  return cloudOf(points);
}

TEST(Explanation, SaysThatACloudWasThinnedOutTooMuch)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  const Localization thin = Localizer().localize(voxelGrid(cloud, 0.01));
  EXPECT_TRUE(thin.handles.empty());
  EXPECT_NEAR(thin.point_spacing, 0.01, 0.002);
  const std::string text = explainNothing(thin, Config());
  expectSentence(text, {"too sparse", "9.4 mm apart", "26 mm", "shell/min_points_inside = 40", "voxel grid"});
  EXPECT_EQ(text.find("flatter"), std::string::npos) << text;

  // A grid of 3 mm is fine enough, and thresholds of a range image follow its density.
  EXPECT_FALSE(Localizer().localize(voxelGrid(cloud, 0.003)).handles.empty());
  EXPECT_TRUE(std::isnan(Localizer().localize(captureScene("empty_table", 1).cloud).point_spacing));
  const Localization fine = Localizer().localize(voxelGrid(captureScene("empty_table", 1).cloud, 0.003));
  EXPECT_NEAR(fine.point_spacing, 0.003, 0.001);
  expectSentence(explainNothing(fine, Config()), {"flatter", "(low_curvature)"});
}

TEST(Explanation, SaysThatShellsAreTooFewForAHandle)
{
  Localization result = endedIn(Outcome::low_curvature);
  result.shells.resize(2);
  expectSentence(explainNothing(result, Config()),
                 {"2 shells were", "handles/min_support = 3", "handles/min_score = 0.66", "sampling/samples"});
  result.shells.resize(1);
  expectSentence(explainNothing(result, Config()), {"1 shell was"});
}

TEST(Explanation, BlamesTheTimeBudgetEvenWhereShellsWereFound)
{
  Localization result = endedIn(Outcome::out_of_time);
  result.shells.resize(2);
  expectSentence(explainNothing(result, Config()), {"sampling/time_budget_ms"});
  result = endedIn(Outcome::out_of_time, 1000);
  result.shells.resize(2);
  expectSentence(explainNothing(result, Config()), {"handles/min_support"});
}

TEST(Explanation, NamesEachReasonWhyNothingWasSampled)
{
  const std::pair<NothingSampled, std::string> cases[] = {
      {NothingSampled::no_cloud, "there was no cloud to draw samples from"},
      {NothingSampled::empty_cloud, "check the sensor"},
      {NothingSampled::nothing_measured, "check the sensor"},
      {NothingSampled::points_coincide, "check the sensor"},
      {NothingSampled::outside_workspace, "workspace/min_x to workspace/max_z"}};
  ASSERT_EQ(std::size(cases), kNothingSampledReasons);
  for (const auto& [reason, part] : cases) {
    Localization result;
    result.nothing_sampled = reason;
    result.warnings = {"a text that mentions nothing to localize: within the workspace"};
    expectSentence(explainNothing(result, Config()), {describe(reason), part});
  }
}

/// Of several clouds that cannot be sampled, the one that came nearest to it tells the reason.
TEST(Explanation, OfSeveralCloudsIsTheReasonOfTheOneNearestToASample)
{
  Cloud empty, unmeasured, coincident;
  unmeasured.reset(64, 48);
  coincident.reset(64, 48);
  for (std::size_t i = 0; i < coincident.size(); ++i) {
    coincident.set(i, 0.1F, 0.2F, 1.0F);
  }
  Config config;
  config.workspace.min_x = 50.0;
  Localizer localizer(config);
  const auto reason = [&](const std::vector<const Cloud*>& clouds) {
    std::vector<PosedCloud> views;
    for (const Cloud* cloud : clouds) {
      views.push_back({cloud, Eigen::Isometry3d::Identity()});
    }
    Localization result;
    localizer.localize(views, result);
    EXPECT_EQ(result.sampled, 0U);
    return result.nothing_sampled;
  };
  const Cloud table = captureScene("table", 1).cloud;
  EXPECT_EQ(reason({}), NothingSampled::no_cloud);
  EXPECT_EQ(reason({&empty, &empty}), NothingSampled::empty_cloud);
  EXPECT_EQ(reason({&unmeasured, &empty}), NothingSampled::nothing_measured);
  EXPECT_EQ(reason({&empty, &coincident, &unmeasured}), NothingSampled::points_coincide);
  EXPECT_EQ(reason({&coincident, &table}), NothingSampled::outside_workspace);
}

/// Of clouds that give no sample.
TEST(Explanation, SaysWhyNothingWasSampled)
{
  Localizer localizer;
  const auto explained = [&](const Cloud& cloud) {
    return explainNothing(localizer.localize(cloud), localizer.config());
  };
  Cloud cloud;
  expectSentence(explained(cloud), {"the cloud is empty", "check the sensor"});
  cloud.reset(640, 480);
  expectSentence(explained(cloud), {"all points are NaN, zero or infinite", "check the sensor"});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.set(i, 0.1F, 0.2F, 1.0F);
  }
  expectSentence(explained(cloud), {"coincide"});
  Config config;
  config.workspace.min_x = 50.0;
  localizer.configure(config);
  expectSentence(explained(captureScene("table", 1).cloud), {"within the workspace", "workspace/min_x"});
  expectSentence(explainNothing(Localization(), config), {"no cloud"});
}

TEST(Explanation, OfAnEmptyTableIsItsFlatness)
{
  const Localization result = Localizer().localize(captureScene("empty_table", 1).cloud);
  EXPECT_TRUE(result.handles.empty());
  expectSentence(explainNothing(result, Config()), {"of 2000 samples", "hand/"});
}

}  // namespace
}  // namespace grasp_affordances::test
