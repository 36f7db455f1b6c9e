#include "core/handles/shell_groups.h"

#include "support/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Eigen::Vector3d;
using Shells = std::vector<Shell>;
using Indices = std::set<std::uint32_t>;

const HandlesConfig kConfig;

Shell shellAt(const Vector3d& centroid, const Vector3d& axis, double length = 0.06, double inner_radius = 0.01)
{
  Shell shell;
  shell.centroid = centroid;
  shell.axis = withLargestComponentPositive(axis.normalized());
  shell.length = length;
  shell.inner_radius = inner_radius;
  return shell;
}

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

std::set<Indices> groupsOf(const Shells& shells, const HandlesConfig& config = kConfig)
{
  ShellGroups groups;
  groups.update(shells, config);
  std::set<Indices> result;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    result.insert(Indices(groups[g].begin(), groups[g].end()));
  }
  return result;
}

/// The transitive closure of shareAxis(), by looking at all pairs.
std::set<Indices> bruteForceGroups(const Shells& shells, const HandlesConfig& config)
{
  std::set<Indices> result;
  std::vector<bool> seen(shells.size());
  for (std::uint32_t i = 0; i < shells.size(); ++i) {
    if (seen[i]) {
      continue;
    }
    std::vector<std::uint32_t> group = {i};
    seen[i] = true;
    for (std::size_t next = 0; next < group.size(); ++next) {
      for (std::uint32_t j = 0; j < shells.size(); ++j) {
        if (!seen[j] && shareAxis(shells[group[next]], shells[j], config)) {
          seen[j] = true;
          group.push_back(j);
        }
      }
    }
    result.insert(Indices(group.begin(), group.end()));
  }
  return result;
}

/// About some bars and round things within a box, so that there are groups of many sizes.
Shells randomShells(std::size_t count, Random& random)
{
  const auto anywhere = [&](double extent) {
    const double x = random.uniform(-extent, extent), y = random.uniform(-extent, extent);
    return Vector3d(x, y, random.uniform(-extent, extent));
  };
  Shells seeds, shells;
  for (int i = 0; i < 12; ++i) {
    const Vector3d centroid = anywhere(0.1), axis = random.direction();
    seeds.push_back(shellAt(centroid, axis, random.uniform(0.03, 0.12), random.uniform(0.005, 0.026)));
  }
  while (shells.size() < count) {
    const Shell& seed = seeds[shells.size() % seeds.size()];
    const Vector3d centroid = seed.centroid + random.uniform(-0.1, 0.1) * seed.axis + anywhere(0.006);
    const Vector3d axis = seed.axis + 0.3 * random.direction();
    const double length = random.uniform(0.03, 0.06);
    shells.push_back(shellAt(centroid, axis, length, seed.inner_radius + random.uniform(-0.003, 0.006)));
  }
  return shells;
}

TEST(ShellGroups, AreTheTransitiveClosure)
{
  std::size_t fewest = 1000, most = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Shells shells = randomShells(seed * 5 % 150, random);
    HandlesConfig config;
    config.max_angle = random.uniform(0.0, 1.2);
    config.max_distance = random.uniform(0.0, 0.01);
    config.max_gap = random.uniform(0.0, 0.03);
    const std::set<Indices> expected = bruteForceGroups(shells, config);
    EXPECT_EQ(groupsOf(shells, config), expected) << "seed " << seed;
    if (shells.size() > 50) {
      fewest = std::min(fewest, expected.size());
      most = std::max(most, expected.size());
    }
  }
  EXPECT_LT(fewest, most) << "the draws are of many kinds";
}

TEST(ShellGroups, DoNotDependOnTheOrderNorOnWhatWasGroupedBefore)
{
  ShellGroups groups;
  std::mt19937 shuffler(1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Shells shells = randomShells(seed % 3 == 0 ? 10 : 100, random);
    std::vector<std::uint32_t> order(shells.size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), shuffler);
    Shells shuffled;
    for (const std::uint32_t i : order) {
      shuffled.push_back(shells[i]);
    }
    groups.update(shuffled, kConfig);
    std::set<Indices> result;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      Indices original;
      for (const std::uint32_t i : groups[g]) {
        original.insert(order[i]);
      }
      EXPECT_TRUE(std::is_sorted(groups[g].begin(), groups[g].end()));
      result.insert(original);
    }
    EXPECT_EQ(result, groupsOf(shells)) << "seed " << seed;
    ASSERT_GT(groups.size(), 0U);
    EXPECT_EQ(groups[0][0], 0U) << "the group of the first shell comes first";
  }
}

TEST(ShellGroups, OfNothingAreNone)
{
  EXPECT_TRUE(groupsOf({}).empty());
  EXPECT_EQ(groupsOf({shellAt(Vector3d::Zero(), kX)}), (std::set<Indices>{{0}}));
}

TEST(ShellGroups, FollowABarFromEndToEnd)
{
  Random random(1);
  Shells shells;
  Indices all;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Vector3d aside(0.0, random.uniform(-0.001, 0.001), random.uniform(-0.001, 0.001));
    shells.push_back(shellAt(0.02 * i * kX + aside, kX + 0.1 * random.direction(), 0.03));
    all.insert(i);
  }
  EXPECT_EQ(groupsOf(shells), std::set<Indices>{all});
  std::swap(shells[1], shells[17]);
  EXPECT_EQ(groupsOf(shells), std::set<Indices>{all});
}

TEST(ShellGroups, FollowARing)
{
  Shells shells;
  for (int i = 0; i < 16; ++i) {
    const double angle = 2.0 * M_PI * i / 16.0;
    shells.push_back(shellAt(0.05 * Vector3d(std::cos(angle), std::sin(angle), 0.0),
                             Vector3d(-std::sin(angle), std::cos(angle), 0.0), 0.03));
  }
  EXPECT_EQ(groupsOf(shells).size(), 1U);
}

TEST(ShellGroups, KeepParallelBarsApart)
{
  Shells shells;
  for (int i = 0; i < 5; ++i) {
    // A finger, 8 mm, fits between these bars of radius 1 cm.
    for (const double y : {0.0, 0.028}) {
      shells.push_back(shellAt(0.01 * i * kX + y * kY, kX));
    }
  }
  EXPECT_EQ(groupsOf(shells), (std::set<Indices>{{0, 2, 4, 6, 8}, {1, 3, 5, 7, 9}}));
}

TEST(ShareAxis, IsSymmetric)
{
  std::size_t sharing = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Shells shells = randomShells(100, random);
    for (const Shell& a : shells) {
      EXPECT_TRUE(shareAxis(a, a, kConfig));
      for (const Shell& b : shells) {
        const bool share = shareAxis(a, b, kConfig);
        sharing += share ? 1 : 0;
        ASSERT_EQ(share, shareAxis(b, a, kConfig)) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(sharing, 1000U + 1000U) << "some share beside those that are the same";
}

TEST(ShareAxis, DoesNotDependOnTheFrame)
{
  Random random(1);
  const Shells shells = randomShells(100, random);
  std::size_t different = 0;
  for (int frame = 0; frame < 5; ++frame) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = random.rotation();
    T.translation() = random.direction();
    for (const Shell& a : shells) {
      for (const Shell& b : shells) {
        different += shareAxis(a, b, kConfig) != shareAxis(transformed(a, T), transformed(b, T), kConfig) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(different, 0U);
}

TEST(ShareAxis, HoldsAtACornerButNotWhereBarsMeetOtherwise)
{
  for (const double length : {0.045, 0.06, 0.12}) {
    const double half = length / 2;
    const Shell a = shellAt(Vector3d::Zero(), kX, length);
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(shareAxis(a, shellAt({half, sign * half, 0.0}, kY, length), kConfig)) << "L of " << length;
      EXPECT_TRUE(shareAxis(a, shellAt({-half, 0.0, sign * half}, kZ, length), kConfig)) << "L of " << length;
      EXPECT_FALSE(shareAxis(a, shellAt({0.0, sign * half, 0.0}, kY, length), kConfig)) << "T of " << length;
      EXPECT_FALSE(shareAxis(a, shellAt({half, sign * (half + 0.008), 0.0}, kY, length), kConfig))
          << "beyond the corner, " << length;
    }
    EXPECT_FALSE(shareAxis(a, shellAt(Vector3d::Zero(), kY, length), kConfig)) << "X of " << length;
  }
}

TEST(ShareAxis, AllowsAngleAndDistanceUpToItsLimits)
{
  const Shell a = shellAt(Vector3d::Zero(), kX);
  const auto turnedBy = [](double angle) { return Vector3d(std::cos(angle), std::sin(angle), 0.0); };
  EXPECT_TRUE(shareAxis(a, shellAt(Vector3d::Zero(), turnedBy(kConfig.max_angle - 0.01)), kConfig));
  EXPECT_FALSE(shareAxis(a, shellAt(Vector3d::Zero(), turnedBy(kConfig.max_angle + 0.01)), kConfig));
  EXPECT_TRUE(shareAxis(a, shellAt((kConfig.max_distance - 1e-4) * kY, kX), kConfig));
  EXPECT_FALSE(shareAxis(a, shellAt((kConfig.max_distance + 1e-4) * kY, kX), kConfig));
  const double thicker = a.inner_radius + kConfig.max_radius_difference;
  EXPECT_TRUE(shareAxis(a, shellAt(Vector3d::Zero(), kX, 0.06, thicker - 1e-4), kConfig));
  EXPECT_FALSE(shareAxis(a, shellAt(Vector3d::Zero(), kX, 0.06, thicker + 1e-4), kConfig));
}

TEST(ShareAxis, AllowsAGapOnlyWhereABarHasAStep)
{
  const Shell slim = shellAt(Vector3d::Zero(), kX, 0.06, 0.01);
  const auto after = [](double gap, double inner_radius) { return shellAt((0.06 + gap) * kX, kX, 0.06, inner_radius); };
  ASSERT_GT(0.008, kConfig.max_distance);
  ASSERT_LT(0.008, kConfig.max_gap);
  EXPECT_FALSE(shareAxis(slim, after(0.008, 0.01), kConfig)) << "something blocks the bar";
  EXPECT_FALSE(shareAxis(slim, after(0.008, 0.0125), kConfig)) << "a radius is not measured to 3 mm";
  EXPECT_TRUE(shareAxis(slim, after(0.008, 0.0135), kConfig)) << "a step";
  EXPECT_FALSE(shareAxis(slim, after(kConfig.max_gap + 1e-4, 0.0135), kConfig)) << "too far";
  EXPECT_TRUE(shareAxis(slim, after(kConfig.max_gap - 1e-4, 0.0135), kConfig)) << "the limit";
  EXPECT_TRUE(shareAxis(slim, after(0.0, 0.01), kConfig));
}

TEST(ShareAxis, HoldsAboutARoundThingAtAnyAngle)
{
  Random random(1);
  constexpr double kRadius = 0.025;
  for (int i = 0; i < 200; ++i) {
    const Shell a = shellAt(0.2 * kRadius * random.direction(), random.direction(), 0.04, kRadius);
    const Shell b = shellAt(0.2 * kRadius * random.direction(), random.direction(), 0.05, kRadius - 0.002);
    EXPECT_TRUE(shareAxis(a, b, kConfig)) << i;
  }
  const Shell round = shellAt(Vector3d::Zero(), kX, 0.05, kRadius);
  EXPECT_FALSE(shareAxis(round, shellAt(0.6 * kRadius * kZ, kY, 0.05, kRadius), kConfig)) << "another one";
  EXPECT_FALSE(shareAxis(round, shellAt(0.3 * kRadius * kZ, kY, 0.11, kRadius), kConfig)) << "not a round one";
}

}  // namespace
}  // namespace grasp_affordances::test
