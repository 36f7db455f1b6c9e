#include "support/given_samples.h"
#include "support/property_cases.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

// Points of a cloud that is not organized: their order says nothing, and those far away do not matter.
namespace grasp_affordances::test
{
namespace
{

/// The points of a cloud in a random order. @param new_places  of each of its points
Cloud permuted(const Cloud& cloud, Random& random, std::vector<std::uint32_t>& new_places)
{
  new_places.resize(cloud.size());
  std::iota(new_places.begin(), new_places.end(), 0U);
  for (std::size_t i = new_places.size() - 1; i > 0; --i) {
    std::swap(new_places[i], new_places[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)))]);
  }
  Cloud result;
  result.sensor_origin = cloud.sensor_origin;
  result.reset(cloud.width, 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.set(new_places[i], cloud.x[i], cloud.y[i], cloud.z[i]);
  }
  return result;
}

std::vector<std::uint32_t> namedAnew(std::vector<std::uint32_t> points, const std::vector<std::uint32_t>& new_places)
{
  for (std::uint32_t& point : points) {
    point = new_places[point];
  }
  return points;
}

// Of equally distant points a k nearest neighborhood holds those with the smaller index: what it holds then depends on
// the order, and such samples are left out. So does the choice of points for curvature, where it is not of all, and of
// sparse normals: neither is made here.
TEST(Properties, PermutedPointsGiveTheSameShells)
{
  Tally all;
  std::size_t ties = 0;
  forEachCase([&](PropertyCase property) {
    const Frame frame = DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed);
    const std::vector<std::uint32_t> points =
        somePoints(frame.cloud, property.config, property.samples, property.random);
    std::vector<std::uint32_t> from, new_places;
    const Cloud cloud = measuredPointsOf(frame.cloud, from);
    const Cloud reordered = permuted(cloud, property.random, new_places);
    GivenSamples before(alone(cloud), property.config), after(alone(reordered), property.config);
    std::vector<std::uint32_t> given;
    for (const std::uint32_t point : placesIn(from, points)) {
      std::vector<std::uint32_t> neighborhood = namedAnew(before.neighborhood({0, point}), new_places);
      std::sort(neighborhood.begin(), neighborhood.end());
      if (neighborhood == after.neighborhood({0, new_places[point]})) {
        given.push_back(point);
      } else {
        ASSERT_EQ(NeighborhoodKind::knn, property.config.neighborhood.kind);
        ++ties;
      }
    }
    const auto expected = before.examine(samplesOf(given));
    const auto actual = after.examine(samplesOf(namedAnew(given, new_places)));
    all.add(compare(
        expected, actual, [](const Shell& shell) { return shell; }, kRounding));
  });
  conclude("permuted", all);
  EXPECT_EQ(0U, all.flipped);
  EXPECT_EQ(0U, all.off);
  EXPECT_LE(ties, all.samples / 20);
}

TEST(Properties, PointsFarAwayChangeNothing)
{
  Tally all;
  forEachCase([&](PropertyCase property) {
    const Frame frame = DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed);
    const std::vector<std::uint32_t> points =
        somePoints(frame.cloud, property.config, property.samples, property.random);
    std::vector<std::uint32_t> from;
    const Cloud cloud = measuredPointsOf(frame.cloud, from);
    const MeasuredPoints given = samplesOf(placesIn(from, points));
    Cloud more = cloud;
    more.reset(cloud.width + 1000, 1);
    for (std::size_t i = 0; i < more.size(); ++i) {
      const double range = std::pow(10.0, property.random.uniform(1.0, 9.0));  // m
      const Eigen::Vector3f point =
          i < cloud.size() ? cloud.point(i) : Eigen::Vector3f((range * property.random.direction()).cast<float>());
      more.set(i, point.x(), point.y(), point.z());
    }
    GivenSamples before(alone(cloud), property.config), after(alone(more), property.config);
    const auto expected = before.examine(given), actual = after.examine(given);
    for (std::size_t i = 0; i < given.size(); ++i) {
      ASSERT_EQ(expected[i].outcome, actual[i].outcome) << "sample " << i;
      if (expected[i].outcome == Outcome::shell) {
        EXPECT_TRUE(same(expected[i].shell, actual[i].shell)) << "sample " << i;
      }
    }
    const auto handles = before.handles(given, expected), other_handles = after.handles(given, actual);
    ASSERT_EQ(handles.size(), other_handles.size());
    for (std::size_t i = 0; i < handles.size(); ++i) {
      EXPECT_EQ(handles[i].shells, other_handles[i].shells);
      EXPECT_EQ(handles[i].polyline, other_handles[i].polyline);
      EXPECT_EQ(handles[i].radius, other_handles[i].radius);
      EXPECT_EQ(handles[i].score, other_handles[i].score);
    }
    all.add(compare(
        expected, actual, [](const Shell& shell) { return shell; }, kRounding));
  });
  conclude("far points", all);
}

}  // namespace
}  // namespace grasp_affordances::test
