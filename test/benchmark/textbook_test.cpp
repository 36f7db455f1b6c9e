// A yardstick counts only if it measures the same thing: the textbook pipeline fits what the package fits, and finds
// what its preset `paper` finds.

#include "benchmark/textbook.h"

#include "core/fit/circle.h"
#include "core/fit/curvature.h"
#include "core/fit/quadric.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/views/stratified_draw.h"
#include "evaluation/judge.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/parameters.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

textbook::LocalPoints localPoints(const Neighborhood& neighborhood)
{
  textbook::LocalPoints points(3, neighborhood.size());
  for (std::size_t i = 0; i < neighborhood.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) =
        (neighborhood.point(i) - neighborhood.center).cast<double>() / neighborhood.radius;
  }
  return points;
}

std::vector<Neighborhood> sampledNeighborhoods(const Cloud& cloud, int count)
{
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  std::vector<std::uint32_t> measured;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      measured.push_back(i);
    }
  }
  const auto search = makeWindowSearch(*image, measured.size());
  const Config config = presetConfig("paper");
  std::vector<Neighborhood> neighborhoods;
  for (int i = 0; neighborhoods.size() < static_cast<std::size_t>(count); ++i) {
    Neighborhood neighborhood;
    const std::uint32_t sample = drawStratified(measured, {}, config.sampling, static_cast<std::uint64_t>(i));
    search->withinRadius(cloud.point(sample), static_cast<float>(config.hand.capture_radius), neighborhood);
    if (neighborhood.size() >= 50) {
      neighborhoods.push_back(std::move(neighborhood));
    }
  }
  return neighborhoods;
}

TEST(Textbook, FitsTheSameToTheSamePoints)
{
  const std::vector<Neighborhood> neighborhoods = sampledNeighborhoods(captureScene("table", 1).cloud, 300);
  CurvatureScratch scratch;
  std::mt19937 random(1);
  for (const Neighborhood& neighborhood : neighborhoods) {
    const textbook::LocalPoints points = localPoints(neighborhood);
    const auto quadric = textbook::fitQuadric(points);
    const auto fit = fitTaubin(neighborhood);
    ASSERT_TRUE(quadric && fit);
    EXPECT_NEAR(quadric->residual, fit->residual, 1e-6 * fit->residual);

    const auto all = static_cast<int>(neighborhood.size());  // of the points, so that none is drawn
    const auto curvature = textbook::medianCurvature(*quadric, points, all, random);
    const auto expected =
        medianCurvature(fit->quadric, neighborhood, {Eigen::Vector3d::Zero()}, {neighborhood.size(), 0}, scratch);
    ASSERT_TRUE(curvature && expected);
    EXPECT_NEAR(curvature->magnitude / neighborhood.radius, expected->median, 1e-6 / neighborhood.radius);
    EXPECT_LT(lineAngle(curvature->axis, expected->axis), 1e-4);

    const Eigen::Vector3d first = expected->axis.unitOrthogonal(), second = expected->axis.cross(first);
    const textbook::Circle circle = textbook::fitCircle(points, expected->axis);
    const auto expected_circle = fitCircle(neighborhood, first, second);
    ASSERT_TRUE(expected_circle);
    EXPECT_NEAR(circle.radius * neighborhood.radius, expected_circle->radius, 1e-6 * expected_circle->radius);
    EXPECT_LT((neighborhood.radius * circle.center - expected_circle->center.x() * first -
               expected_circle->center.y() * second)
                  .norm(),
              1e-6 * expected_circle->radius);
  }
}

std::uint32_t count(const Localization& result, Outcome outcome)
{
  return result.counts[static_cast<std::size_t>(outcome)];
}

class EveryEstimator : public testing::TestWithParam<Estimator>
{
};

TEST_P(EveryEstimator, EndsWhereThePaperPresetEnds)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config = presetConfig("paper");
  config.estimation.estimator = GetParam();
  config.estimation.curvature_points = 10000;  // more than any neighborhood has, so that none is drawn
  config.occlusion.filter = false;
  config.sampling.samples = 1000;
  const Localization expected = Localizer(config).localize(cloud);
  const Localization found = textbook::Pipeline(config).localize(textbook::toPcl(cloud));
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(std::accumulate(found.counts.begin(), found.counts.end(), 0U), found.sampled);
  for (const Outcome outcome : {Outcome::too_few_points, Outcome::low_curvature, Outcome::no_shell, Outcome::shell}) {
    EXPECT_NEAR(count(found, outcome), count(expected, outcome), 5) << outcomeName(outcome);
  }

  std::map<std::uint32_t, Shell> shells;
  for (const Shell& shell : found.shells) {
    shells[shell.point_index] = shell;
  }
  // PCL's normals are in single precision, and few directions among them tell the axis; a radius is some steps more
  // than the fitted one, which need not be as many.
  const bool single_precision = GetParam() == Estimator::normals;
  const double angle = single_precision ? 0.02 : 1e-3, distance = single_precision ? 1.1e-3 : 1e-4;
  std::size_t common = 0;
  for (const Shell& shell : expected.shells) {
    const auto same = shells.find(shell.point_index);
    if (same != shells.end()) {
      ++common;
      EXPECT_LT(lineAngle(same->second.axis, shell.axis), angle);
      EXPECT_LT((same->second.centroid - shell.centroid).norm(), distance);
      EXPECT_NEAR(same->second.inner_radius, shell.inner_radius, distance);
    }
  }
  EXPECT_GE(common + 5, expected.shells.size());
  EXPECT_GE(common, 10U);
}

INSTANTIATE_TEST_SUITE_P(Textbook, EveryEstimator,
                         testing::Values(Estimator::taubin, Estimator::pca, Estimator::normals),
                         [](const testing::TestParamInfo<Estimator>& info) { return enumWord(info.param); });

std::set<std::uint32_t> foundAffordances(const LabelledFrame& frame, const Localization& result)
{
  const Judge judge(frame.cloud, frame.labels);
  std::set<std::uint32_t> affordances;
  for (const Shell& shell : result.shells) {
    const Verdict verdict = judge(shell);
    if (verdict.kind == Verdict::right) {
      affordances.insert(verdict.affordance);
    }
  }
  return affordances;
}

TEST(Textbook, FindsTheAffordancesOfATable)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const LabelledFrame frame = captureScene("table", seed);
    const Config config = presetConfig("paper");
    const Localization expected = Localizer(config).localize(frame.cloud);
    const Localization found = textbook::Pipeline(config).localize(textbook::toPcl(frame.cloud));
    const std::set<std::uint32_t> mug_bottle_and_bar = {1, 2, 3};
    EXPECT_EQ(foundAffordances(frame, expected), mug_bottle_and_bar) << "seed " << seed;
    EXPECT_EQ(foundAffordances(frame, found), mug_bottle_and_bar) << "seed " << seed;
    // A sphere at an angle a from the optical axis projects to an ellipse, 1 / cos a longer than the textbook's circle.
    EXPECT_NEAR(count(found, Outcome::occluded), count(expected, Outcome::occluded), 0.05 * expected.sampled);
  }
}

TEST(Textbook, SearchesACloudWithoutPixelsInATree)
{
  const Cloud cloud = unorganized(captureScene("table", 1).cloud);
  Config config = presetConfig("paper");
  config.estimation.estimator = Estimator::pca;
  config.sampling.samples = 300;
  const Localization expected = Localizer(config).localize(cloud);
  const Localization found = textbook::Pipeline(config).localize(textbook::toPcl(cloud));
  EXPECT_EQ(count(found, Outcome::occluded), 0U);
  EXPECT_NEAR(count(found, Outcome::shell), count(expected, Outcome::shell), 3);
  EXPECT_GT(count(found, Outcome::shell), 5U);
}

}  // namespace
}  // namespace grasp_affordances::test
