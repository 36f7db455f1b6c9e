#include "core/shell/free_space.h"

#include "support/bars.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grasp_affordances::test
{
namespace
{

TEST(SilhouetteCoverage, IsTheShareThatShowsSurfaceInsideTheShell)
{
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY(), normal = -Eigen::Vector3d::UnitZ();
  ShellSearchResult shell;
  shell.centroid = {0.0, 0.0, 0.8};
  shell.inner_radius = 0.013;
  shell.length = 0.04;
  const auto coverage = [&](const BarImage& bar) { return silhouetteCoverage(bar.image(), shell, axis, normal); };
  EXPECT_GT(coverage(BarImage(0.0129, 0.03, [](double) { return 0.0; })), 0.95);
  EXPECT_NEAR(coverage(BarImage(0.0065, 0.03, [](double) { return 0.0; })), 0.5, 0.1) << "half as wide";
  const auto upper_half = [](double y) { return y < 0.0; };
  EXPECT_NEAR(coverage(BarImage(0.0129, 0.03, [&](double y) { return upper_half(y) ? 1.2 : 0.0; })), 0.5, 0.1);
  EXPECT_GT(coverage(BarImage(0.0129, 0.03, [&](double y) { return upper_half(y) ? 0.5 : 0.0; })), 0.95) << "hidden";
  EXPECT_GT(coverage(BarImage(0.0129, 0.03, [&](double y) { return upper_half(y) ? std::nan("") : 0.0; })), 0.95);
  EXPECT_EQ(coverage(BarImage(0.0129, 0.03, [](double) { return std::nan(""); })), 0.0);
}

}  // namespace
}  // namespace grasp_affordances::test
