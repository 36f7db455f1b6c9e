#include "simulation/camera_orbit.h"
#include "support/given_samples.h"
#include "support/property_cases.h"

#include <gtest/gtest.h>

// Where sensors move together with what they saw, so do shells and handles. A range image is tied to its optical frame:
// its pose moves. A cloud that is not organized is moved itself, with its sensor's origin.
namespace grasp_affordances::test
{
namespace
{

using Pose = Eigen::Isometry3d;

Pose somePose(Random& random)
{
  Pose T = Pose::Identity();
  T.linear() = random.rotation();
  T.translation() = random.uniform(0.0, 0.5) * random.direction();
  return T;
}

/// Handles are compared by their shells, and what they are by their geometry, where the axis is straight: the nodes of
/// a bent one are gathered in the order of the shells' coordinates.
void compareHandles(const std::vector<GraspHandle>& expected, const std::vector<GraspHandle>& actual, const Pose& T)
{
  constexpr double kConverged = 1e-5;  // m or 1; the fit stops where it moves by less than 1e-6 m
  ASSERT_EQ(expected.size(), actual.size());
  for (const GraspHandle& handle : expected) {
    const auto found = std::find_if(actual.begin(), actual.end(),
                                    [&](const GraspHandle& other) { return other.shells == handle.shells; });
    ASSERT_NE(actual.end(), found);
    if (handle.polyline.size() != 2) {
      continue;
    }
    EXPECT_LT((T * handle.centroid - found->centroid).norm(), kConverged);
    EXPECT_LT(lineAngle(T.linear() * handle.axis, found->axis), kConverged / 0.01);
    EXPECT_LT((T.linear() * handle.normal - found->normal).norm(), kConverged / 0.01);
    EXPECT_NEAR(handle.radius, found->radius, kConverged);
    EXPECT_NEAR(handle.length, found->length, kConverged);
    EXPECT_NEAR(handle.score, found->score, kConverged);
  }
}

TEST(Properties, MovedViewsMoveTheirShellsAndHandles)
{
  Tally all;
  std::size_t all_handles = 0;
  forEachCase([&](PropertyCase property) {
    property.config.handles.min_score = 0.0;
    const View aside = viewFromAside(property.view, 0.7);
    const Frame frames[] = {DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed),
                            DepthCamera().capture(aside.scene, aside.T_scene_camera, property.seed + 1)};
    const std::vector<PosedCloud> clouds{{&frames[0].cloud, property.view.T_scene_camera},
                                         {&frames[1].cloud, aside.T_scene_camera}};
    MeasuredPoints given;
    for (std::size_t view = 0; view < clouds.size(); ++view) {
      const MeasuredPoints more =
          samplesOf(somePoints(*clouds[view].cloud, property.config, property.samples, property.random), view);
      given.insert(given.end(), more.begin(), more.end());
    }
    const Pose T = somePose(property.random);
    std::vector<PosedCloud> moved = clouds;
    for (PosedCloud& cloud : moved) {
      cloud.T_common_cloud = T * cloud.T_common_cloud;
    }
    GivenSamples before(clouds, property.config), after(moved, property.config);
    const auto expected = before.examine(given), actual = after.examine(given);
    all.add(compare(
        expected, actual, [&](const Shell& shell) { return transformed(shell, T); }, kRounding));
    const std::vector<GraspHandle> handles = before.handles(given, expected);
    compareHandles(handles, after.handles(given, actual), T);
    all_handles += handles.size();

    // What another sensor saw far away is of no account.
    Cloud far;
    far.reset(1000, 1);
    for (std::size_t i = 0; i < far.size(); ++i) {
      const Eigen::Vector3f point =
          (std::pow(10.0, property.random.uniform(1.5, 9.0)) * property.random.direction()).cast<float>();
      far.set(i, point.x(), point.y(), point.z());
    }
    std::vector<PosedCloud> more = clouds;
    more.push_back({&far, Pose::Identity()});
    GivenSamples with_more(more, property.config);
    const Tally same =
        compare(expected, with_more.examine(given), [](const Shell& shell) { return shell; }, {0.0, 1e-7, 0.0});
    EXPECT_EQ(0U, same.flipped);
    EXPECT_EQ(0U, same.off);
  });
  conclude("moved views", all);
  EXPECT_EQ(0U, all.flipped);
  EXPECT_EQ(0U, all.off);
  EXPECT_GE(all_handles, 3U);
}

// Coordinates of 1 to 2 m are rounded to single precision, by up to 6e-8 m each. With that points come into
// neighborhoods or leave them: with 500 points within 26 mm, 3 / 26 mm of them per m of the radius, the rounding of
// 2e-7 m concerns one neighborhood in a hundred. What is exactly coplanar, as pixels of the same disparity may be, is
// so no more, and not degenerate then.
TEST(Properties, MovedPointsMoveTheirShells)
{
  Tally all;
  std::size_t samples = 0, other_neighborhoods = 0;
  forEachCase([&](PropertyCase property) {
    const Frame frame = DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed);
    std::vector<std::uint32_t> from;
    const Cloud cloud = measuredPointsOf(frame.cloud, from);
    const MeasuredPoints given =
        samplesOf(placesIn(from, somePoints(frame.cloud, property.config, property.samples, property.random)));
    const Pose T = somePose(property.random);
    const Cloud moved_cloud = moved(cloud, T);
    GivenSamples before(alone(cloud), property.config), after(alone(moved_cloud), property.config);
    const auto expected = before.examine(given), actual = after.examine(given);
    std::vector<SampleResult> comparable, moved_comparable;
    for (std::size_t i = 0; i < given.size(); ++i) {
      ++samples;
      const bool degenerate = expected[i].outcome == Outcome::degenerate || actual[i].outcome == Outcome::degenerate;
      if (before.neighborhood(given[i]) != after.neighborhood(given[i])) {
        ++other_neighborhoods;
      } else if (degenerate) {
        EXPECT_NE(Outcome::shell, expected[i].outcome);
        EXPECT_NE(Outcome::shell, actual[i].outcome);
      } else {
        comparable.push_back(expected[i]);
        moved_comparable.push_back(actual[i]);
      }
    }
    // Rounding turns axes by its ratio to the neighborhood's size, 1e-5 rad, and more where the arc that is seen is
    // flat.
    const Tolerance tolerance{1e-5, 1e-3, 1e-3};
    all.add(compare(
        comparable, moved_comparable, [&](const Shell& shell) { return transformed(shell, T); }, tolerance));
  });
  conclude("moved points", all);
  EXPECT_LE(other_neighborhoods, samples / 50 + 5);
  EXPECT_LE(all.flipped, all.samples / 200);  // a point crossed the edge of a shell or of a slice, and it mattered
  EXPECT_LE(all.off, all.shells / 20);        // or was counted on the other side
}

/// Coordinates that single precision represents wherever they are moved by multiples of this.
constexpr double kGrid = 0x1p-16;  // m

Cloud onGrid(const Cloud& cloud)
{
  Cloud result = cloud;
  const auto rounded = [](float value) { return static_cast<float>(std::round(value / kGrid) * kGrid); };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.set(i, rounded(cloud.x[i]), rounded(cloud.y[i]), rounded(cloud.z[i]));
  }
  return result;
}

TEST(Properties, PointsMovedWithoutRoundingMoveTheirShells)
{
  Tally all;
  forEachCase([&](PropertyCase property) {
    const Frame frame = DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed);
    std::vector<std::uint32_t> from;
    const Cloud cloud = onGrid(measuredPointsOf(frame.cloud, from));
    const MeasuredPoints given =
        samplesOf(placesIn(from, somePoints(frame.cloud, property.config, property.samples, property.random)));
    Pose T = Pose::Identity();
    for (int axis = 0; axis < 3; ++axis) {
      T.translation()[axis] = std::round(property.random.uniform(-0.5, 0.5) / kGrid) * kGrid;
    }
    const Cloud moved_cloud = moved(cloud, T);
    GivenSamples before(alone(cloud), property.config), after(alone(moved_cloud), property.config);
    const auto expected = before.examine(given), actual = after.examine(given);
    all.add(compare(
        expected, actual, [&](const Shell& shell) { return transformed(shell, T); }, kRounding));
  });
  conclude("points moved without rounding", all);
  EXPECT_EQ(0U, all.flipped);
  EXPECT_EQ(0U, all.off);
}

}  // namespace
}  // namespace grasp_affordances::test
