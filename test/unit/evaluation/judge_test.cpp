#include "evaluation/judge.h"
#include "evaluation/labelled_cloud.h"
#include "support/evaluations.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace grasp_affordances::test
{
namespace
{

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

}  // namespace
}  // namespace grasp_affordances::test
