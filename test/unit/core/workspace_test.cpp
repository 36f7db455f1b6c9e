#include "grasp_affordances/localizer.h"
#include "support/points.h"
#include "support/scenes.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace grasp_affordances::test
{
namespace
{

using Pose = Eigen::Isometry3d;

/// A box in a tilted frame, across the middle of the scene.
struct Box
{
  Pose T_box_cloud;
  WorkspaceConfig limits;

  bool holds(const Eigen::Vector3d& point_cloud) const
  {
    const Eigen::Vector3d p = T_box_cloud * point_cloud;
    return p.x() >= limits.min_x && p.x() <= limits.max_x && p.y() >= limits.min_y && p.y() <= limits.max_y &&
           p.z() >= limits.min_z && p.z() <= limits.max_z;
  }
};

Box boxAround(const Eigen::Vector3d& center)
{
  Box box;
  box.T_box_cloud = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 1.0, 0.3).normalized()) * Eigen::Translation3d(-center);
  box.limits.min_x = -0.05;
  box.limits.max_x = 0.06;
  box.limits.min_y = -0.07;
  box.limits.max_y = 0.05;
  box.limits.min_z = -0.1;  // and no upper limit
  return box;
}

Localization localizeWithin(const Box& box, Config config, const Cloud& cloud)
{
  config.workspace = box.limits;
  Localization result;
  Localizer(config).localize(cloud, result, box.T_box_cloud);
  return result;
}

class EveryPreset : public testing::TestWithParam<const char*>
{
};

TEST_P(EveryPreset, SamplesWithinTheWorkspaceOnly)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config = presetConfig(GetParam());
  const Localization all = Localizer(config).localize(cloud);
  ASSERT_GT(all.shells.size(), 20U);
  const Box box = boxAround(all.shells.front().centroid);
  const Localization within = localizeWithin(box, config, cloud);
  EXPECT_EQ(within.sampled, all.sampled);
  EXPECT_EQ(within.points, all.points) << "measured points, inside or not";
  ASSERT_GT(within.shells.size(), 10U);
  for (const Shell& shell : within.shells) {
    EXPECT_TRUE(box.holds(cloud.point(shell.point_index).cast<double>()));
  }
  EXPECT_TRUE(std::any_of(all.shells.begin(), all.shells.end(), [&](const Shell& shell) {
    return !box.holds(cloud.point(shell.point_index).cast<double>());
  })) << "the box leaves something out";
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryPreset, testing::Values("localizer", "paper"));

TEST(Workspace, WhatIsOutsideStillCounts)
{
  // PCA draws no random numbers per sample, so that a point gives the same shell whenever it is drawn.
  Config config;
  config.estimation.estimator = Estimator::pca;
  const Cloud cloud = captureScene("table", 1).cloud;
  const Localization all = Localizer(config).localize(cloud);
  const Localization within = localizeWithin(boxAround(all.shells.front().centroid), config, cloud);
  std::size_t twins = 0;
  for (const Shell& shell : within.shells) {
    const auto twin = std::find_if(all.shells.begin(), all.shells.end(),
                                   [&](const Shell& other) { return other.point_index == shell.point_index; });
    if (twin != all.shells.end()) {
      ++twins;
      EXPECT_TRUE(same(*twin, shell));
    }
  }
  EXPECT_GT(twins, 10U);
}

TEST(Workspace, WithoutAPointIsSaid)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  const Localization none = localizeWithin(boxAround({0.0, 0.0, -50.0}), Config(), cloud);
  EXPECT_EQ(none.sampled, 0U);
  EXPECT_TRUE(none.shells.empty());
  ASSERT_EQ(none.warnings.size(), 1U);
  EXPECT_NE(none.warnings[0].find("workspace"), std::string::npos);
}

TEST(Workspace, EachSideAloneIsALimit)
{
  EXPECT_FALSE(WorkspaceConfig().isLimit());
  const double limit = std::nextafter(WorkspaceConfig::kNoLimit, 0.0);
  for (double WorkspaceConfig::*min : {&WorkspaceConfig::min_x, &WorkspaceConfig::min_y, &WorkspaceConfig::min_z}) {
    WorkspaceConfig box;
    box.*min = -limit;
    EXPECT_TRUE(box.isLimit());
  }
  for (double WorkspaceConfig::*max : {&WorkspaceConfig::max_x, &WorkspaceConfig::max_y, &WorkspaceConfig::max_z}) {
    WorkspaceConfig box;
    box.*max = limit;
    EXPECT_TRUE(box.isLimit());
  }
}

TEST(Workspace, AnEmptyBoxIsRefused)
{
  Config config;
  config.workspace.min_y = 0.2;
  config.workspace.max_y = 0.2;
  try {
    Localizer localizer(config);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("workspace/max_y"), std::string::npos);
  }
}

}  // namespace
}  // namespace grasp_affordances::test
