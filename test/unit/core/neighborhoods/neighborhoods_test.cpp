#include "core/neighborhoods/neighborhoods.h"
#include "core/neighborhoods/tree_search.h"

#include "core/parallel/thread_team.h"
#include "io/bag.h"
#include "io/pcd.h"
#include "support/points.h"
#include "support/recordings.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

std::vector<std::uint32_t> indicesOf(const Neighborhood& neighborhood)
{
  return {neighborhood.index(), neighborhood.index() + neighborhood.size()};
}

std::vector<std::uint32_t> bruteForceNearest(const Cloud& cloud, const Eigen::Vector3f& center, std::size_t k)
{
  std::vector<std::pair<float, std::uint32_t>> order;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      const Eigen::Vector3f d = cloud.point(i) - center;
      order.emplace_back(d.x() * d.x() + d.y() * d.y() + d.z() * d.z(), static_cast<std::uint32_t>(i));
    }
  }
  k = std::min(k, order.size());
  // cppcheck-suppress containerOutOfBounds; k is at most their number
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(k), order.end());
  std::vector<std::uint32_t> nearest;
  for (std::size_t i = 0; i < k; ++i) {
    nearest.push_back(order[i].second);
  }
  std::sort(nearest.begin(), nearest.end());
  return nearest;
}

/// Window, tree and brute force give the same points, in the same order, around points and beside them.
void expectSameNeighborhoods(const Cloud& cloud, std::uint64_t seed, int places)
{
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  ASSERT_TRUE(image) << warning;
  const auto window = makeWindowSearch(*image, measuredPoints(cloud));
  const auto tree = makeTreeSearch(cloud);
  Random random(seed);
  Neighborhood from_window, from_tree;
  for (int i = 0; i < places;) {
    const auto point = static_cast<std::size_t>(random.uniform(0, static_cast<double>(cloud.size())));
    if (!cloud.measured(point)) {
      continue;
    }
    const float offset = i % 2 == 0 ? 0.0F : 0.03F;
    const Eigen::Vector3f center = cloud.point(point) + offset * random.direction().cast<float>();
    const auto radius = static_cast<float>(random.uniform(0.003, 0.06));
    window->withinRadius(center, radius, from_window);
    tree->withinRadius(center, radius, from_tree);
    const auto expected = indicesOf(bruteForceNeighborhood(cloud, center, radius));
    ASSERT_EQ(indicesOf(from_window), expected) << "point " << point << " radius " << radius;
    ASSERT_EQ(indicesOf(from_tree), expected) << "point " << point << " radius " << radius;

    const auto k = static_cast<std::size_t>(random.uniform(1, 700));
    window->nearest(center, k, from_window);
    tree->nearest(center, k, from_tree);
    const auto nearest = bruteForceNearest(cloud, center, k);
    ASSERT_EQ(indicesOf(from_window), nearest) << "point " << point << " k " << k;
    ASSERT_EQ(indicesOf(from_tree), nearest) << "point " << point << " k " << k;
    ASSERT_EQ(from_window.radius, from_tree.radius);
    ++i;
  }
}

TEST(NeighborhoodSearch, AgreesWithBruteForceOnASimulatedCloud)
{
  expectSameNeighborhoods(captureScene("table", 3).cloud, 1, 60);
}

class RecordedCloud : public testing::TestWithParam<const char*>
{
};

TEST_P(RecordedCloud, AgreesWithBruteForce)
{
  REQUIRE_RECORDINGS(folder);
  expectSameNeighborhoods(readPcdCloud(folder + "/" + GetParam()), 2, 40);
}

INSTANTIATE_TEST_SUITE_P(NeighborhoodSearch, RecordedCloud,
                         testing::Values("mosd/learn5.pcd", "mosd/learn20.pcd", "mosd/learn31.pcd", "mosd/learn33.pcd",
                                         "mosd/learn38.pcd", "mosd/learn39.pcd", "mosd/learn40.pcd", "mosd/learn42.pcd",
                                         "mosd/learn43.pcd", "mosd/learn44.pcd",
                                         "pcl/milk_cartoon_all_small_clorox.pcd"),
                         [](const testing::TestParamInfo<const char*>& info) {
                           std::string name(info.param);
                           name = name.substr(name.find('/') + 1);
                           return name.substr(0, name.find('.'));
                         });

TEST(NeighborhoodSearch, AgreesWithBruteForceOnTheRecordedBag)
{
  REQUIRE_RECORDINGS(folder);
  BagVisitor visitor;
  visitor.malformed = [](const std::string& reason, std::size_t, std::size_t) { FAIL() << reason; };
  visitor.cloud = [](const sensor_msgs::PointCloud2& message, std::size_t, std::size_t) {
    Cloud cloud;
    cloudFromPointCloud2(message, cloud);
    expectSameNeighborhoods(cloud, 2, 40);
  };
  readBagClouds(folder + "/bags/soda_can.bag", "", visitor);
}

TEST(NeighborhoodSearch, BreaksTiesByIndex)
{
  // Six points at the same distance, of which k = 4 takes the first ones and the centre.
  const Points points{{0.01, 0, 1}, {-0.01, 0, 1}, {0, 0.01, 1}, {0, 0, 1}, {0, -0.01, 1}, {0.01, 0, 1}, {0, 0.01, 1}};
  const Cloud cloud = cloudOf(points);
  Neighborhood nearest;
  makeTreeSearch(cloud)->nearest({0, 0, 1}, 4, nearest);
  EXPECT_EQ(indicesOf(nearest), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(NeighborhoodSearch, FindsCoincidentPoints)
{
  const Cloud cloud = cloudOf(Points(20, Eigen::Vector3d(0.1, 0.2, 1.0)));
  const auto tree = makeTreeSearch(cloud);
  Neighborhood found;
  tree->nearest(cloud.point(0), 10, found);
  EXPECT_EQ(indicesOf(found), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(found.radius, 0.0F);
  tree->withinRadius(cloud.point(0), 0.0F, found);
  EXPECT_EQ(found.size(), 20U);
}

/// The tree goes through the whole cloud while spheres hold many of its points: its answers stay the same.
TEST(NeighborhoodSearch, FindsTheSameInACrowd)
{
  constexpr std::uint64_t kSeed = 7;
  Random random(kSeed);
  Points points;
  for (int i = 0; i < 4000; ++i) {
    const double size = i % 2 == 0 ? 0.005 : 0.5;
    points.emplace_back(random.uniform(-size, size), random.uniform(-size, size), 1.0 + random.uniform(-size, size));
  }
  const Cloud cloud = cloudOf(points);
  const auto tree = makeTreeSearch(cloud);
  Neighborhood found;
  for (int i = 0; i < 60; ++i) {
    const auto point = static_cast<std::size_t>(random.uniform(0, 4000));
    const auto radius = static_cast<float>(random.uniform(0.001, 0.1));
    tree->withinRadius(cloud.point(point), radius, found);
    ASSERT_EQ(indicesOf(found), indicesOf(bruteForceNeighborhood(cloud, cloud.point(point), radius))) << i;
    const auto k = static_cast<std::size_t>(random.uniform(1, 700));
    tree->nearest(cloud.point(point), k, found);
    ASSERT_EQ(indicesOf(found), bruteForceNearest(cloud, cloud.point(point), k)) << i;
  }
}

/// Points of a kind, and how far from one another they are.
struct Arrangement
{
  const char* name;
  double size;  // m
  Eigen::Vector3d (*point)(int i, Random& random);
};

constexpr Arrangement kArrangements[] = {
    {"cube", 1.0,
     [](int, Random& random) {
       const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
       return Eigen::Vector3d(x, y, random.uniform(0.5, 2));
     }},
    {"plane", 1.0,
     [](int, Random& random) {
       const double x = random.uniform(-1, 1);
       return Eigen::Vector3d(x, random.uniform(-1, 1), 1.0);
     }},
    {"line, every point three times", 1.0, [](int i, Random&) { return Eigen::Vector3d(1e-3 * (i / 3), 0.2, 1.0); }},
    {"crowds far apart", 1e-3,
     [](int i, Random& random) {
       const Eigen::Vector3d center(i % 5, 1e3 * (i % 2), 1.0);
       return Eigen::Vector3d(center + 1e-3 * random.uniform(0, 1) * random.direction());
     }},
    {"one place and some others", 1.0,
     [](int i, Random& random) {
       const double x = i % 8 == 0 ? random.uniform(-1, 1) : 0.1;
       return Eigen::Vector3d(x, 0.1, 1.0);
     }},
    {"a few very far away", 1.0,
     [](int i, Random& random) {
       const double size = i % 500 == 0 ? 1e18 : 1.0;
       return Eigen::Vector3d(size * random.direction());
     }},
    {"all very far away", 1e18, [](int, Random& random) { return Eigen::Vector3d(1e18 * random.direction()); }},
    {"all very near", 1e-18, [](int, Random& random) { return Eigen::Vector3d(1e-18 * random.direction()); }},
    {"so near that squares underflow", 1e-21,
     [](int, Random& random) {
       return Eigen::Vector3d(1e-18 * Eigen::Vector3d::UnitX() + 1e-21 * random.direction());
     }},
};

/// Whatever the extent of a cloud, its order, the radius, and the threads that make the tree.
TEST(NeighborhoodSearch, FindsTheSameInTreesOfAnyPoints)
{
  for (const Arrangement& arrangement : kArrangements) {
    for (const int count : {1, 63, 65, 130, 1000, 20000}) {
      Random random(3);
      Points points;
      for (int i = 0; i < count; ++i) {
        points.push_back(arrangement.point(i, random));
      }
      Cloud cloud = cloudOf(points);
      for (std::size_t i = 5; i < cloud.size(); i += 7) {
        cloud.x[i] = cloud.y[i] = cloud.z[i] = std::nanf("");
      }
      ThreadTeam three(3);
      TreeSearch shared;
      shared.update(cloudOf({{1, 2, 3}}));  // memory of another cloud
      shared.update(cloud, &three);
      const auto alone = makeTreeSearch(cloud);
      Neighborhood from_shared, from_alone;
      for (int i = 0; i < 20; ++i) {
        const auto point = static_cast<std::size_t>(random.uniform(0, count));
        const Eigen::Vector3f beside = (arrangement.size * random.uniform(0, 2) * random.direction()).cast<float>();
        const Eigen::Vector3f center = cloud.measured(point) ? cloud.point(point) : beside;
        const auto radius = static_cast<float>(arrangement.size * std::pow(10.0, random.uniform(-4, 1)));
        const std::string where = std::string(arrangement.name) + ", " + std::to_string(count) + " points, place " +
                                  std::to_string(i) + ", radius " + std::to_string(radius);
        alone->withinRadius(center, radius, from_alone);
        shared.withinRadius(center, radius, from_shared);
        const Neighborhood expected = bruteForceNeighborhood(cloud, center, radius);
        ASSERT_EQ(indicesOf(from_alone), indicesOf(expected)) << where;
        ASSERT_EQ(indicesOf(from_shared), indicesOf(expected)) << where;
        for (std::size_t j = 0; j < expected.size(); ++j) {
          ASSERT_EQ(from_alone.point(j), expected.point(j)) << where;
        }
        const auto k = static_cast<std::size_t>(random.uniform(1, 600));
        alone->nearest(center, k, from_alone);
        shared.nearest(center, k, from_shared);
        ASSERT_EQ(indicesOf(from_alone), bruteForceNearest(cloud, center, k)) << where << ", k " << k;
        ASSERT_EQ(indicesOf(from_shared), indicesOf(from_alone)) << where << ", k " << k;
      }
    }
  }
}

/// Points that are neighbors in space, in any order: they come back in the order of their indices.
TEST(NeighborhoodSearch, FindsTheSameInAShuffledCloud)
{
  Random random(5);
  Cloud cloud = unorganized(captureScene("table", 2).cloud);
  for (std::size_t i = cloud.size() - 1; i > 0; --i) {
    const auto other = static_cast<std::size_t>(random.uniform(0, static_cast<double>(i + 1)));
    for (std::vector<float>* coordinates : {&cloud.x, &cloud.y, &cloud.z}) {
      std::swap((*coordinates)[i], (*coordinates)[other]);
    }
  }
  const auto tree = makeTreeSearch(cloud);
  Neighborhood found;
  for (std::size_t i = 0; i < cloud.size(); i += 3001) {
    if (cloud.measured(i)) {
      const auto radius = static_cast<float>(random.uniform(0.002, 0.2));
      tree->withinRadius(cloud.point(i), radius, found);
      ASSERT_EQ(indicesOf(found), indicesOf(bruteForceNeighborhood(cloud, cloud.point(i), radius))) << i;
      tree->nearest(cloud.point(i), 500, found);
      ASSERT_EQ(indicesOf(found), bruteForceNearest(cloud, cloud.point(i), 500)) << i;
    }
  }
}

TEST(NeighborhoodSearch, FindsPointsWhoseDistancesOverflow)
{
  Points points;
  for (int i = 0; i < 12; ++i) {
    points.emplace_back(i % 2 == 0 ? 1e19 : -1e19, 0, i);
  }
  const Cloud cloud = cloudOf(points);
  Neighborhood found;
  makeTreeSearch(cloud)->nearest(cloud.point(0), 12, found);
  EXPECT_EQ(found.size(), 12U);
  constexpr float kLargest = std::numeric_limits<float>::max();
  makeTreeSearch(cloud)->nearest({kLargest, -kLargest, kLargest}, 12, found);
  EXPECT_EQ(found.size(), 12U);
}

TEST(NeighborhoodSearch, FindsNeighborsOfAnyPlace)
{
  const Cloud cloud = captureScene("empty_table", 1).cloud;
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  ASSERT_TRUE(image) << warning;
  Neighborhood from_window, from_tree;
  for (const Eigen::Vector3f& place : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.1F, 0, -0.5F)}) {
    makeWindowSearch(*image, measuredPoints(cloud))->nearest(place, 50, from_window);
    makeTreeSearch(cloud)->nearest(place, 50, from_tree);
    EXPECT_EQ(indicesOf(from_window), indicesOf(from_tree));
    EXPECT_EQ(from_window.size(), 50U);
  }
}

/// As a point of another view that the frame of this one has no number for.
TEST(NeighborhoodSearch, FindsNothingAroundAPlaceThatIsNotFinite)
{
  const Cloud cloud = captureScene("empty_table", 1).cloud;
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  ASSERT_TRUE(image) << warning;
  const auto window = makeWindowSearch(*image, measuredPoints(cloud)), tree = makeTreeSearch(cloud);
  Neighborhood found;
  for (const float value : {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f place(0.1F, 0.1F, 1.0F);
      place[axis] = value;
      const PixelWindow pixels = image->window(place.cast<double>(), 0.1);
      EXPECT_TRUE(pixels.u_begin == pixels.u_end && pixels.v_begin == pixels.v_end) << place.transpose();
      for (const auto* search : {window.get(), tree.get()}) {
        for (const float radius : {0.1F, 1e30F, std::numeric_limits<float>::infinity()}) {
          search->withinRadius(place, radius, found);
          EXPECT_EQ(found.size(), 0U) << place.transpose();
        }
        search->nearest(place, 50, found);
        EXPECT_EQ(found.size(), 0U) << place.transpose();
        EXPECT_EQ(found.radius, 0.0F);
      }
    }
  }
}

TEST(NeighborhoodSearch, GivesAllPointsWhereThereAreFewerThanK)
{
  const Cloud cloud = cloudOf({{0, 0, 1}, {0.3, 0, 1}, {0, 5, 1}});
  Neighborhood nearest;
  makeTreeSearch(cloud)->nearest({0, 0, 1}, 500, nearest);
  EXPECT_EQ(nearest.size(), 3U);
  EXPECT_FLOAT_EQ(nearest.radius, 5.0F);
  const Cloud nothing = cloudOf({});
  makeTreeSearch(nothing)->nearest({0, 0, 1}, 5, nearest);
  EXPECT_EQ(nearest.size(), 0U);
}

}  // namespace
}  // namespace grasp_affordances::test
