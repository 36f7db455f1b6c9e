#include "grasp_affordances/localizer.h"
#include "simulation/camera_orbit.h"
#include "simulation/tableware.h"
#include "support/hand_poses.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// The corridor of a hand, as HandPoseSearch describes it.
bool inCorridor(const Vector& p, const Config& config, double r)
{
  const double begin = -(r + config.hand.palm_depth + config.hand_poses.approach_distance);
  return p.x() >= begin && p.x() <= 0.0 && std::abs(p.y()) <= r + config.hand.finger_thickness &&
         std::abs(p.z()) <= config.hand.palm_width / 2 && std::hypot(p.x(), p.y()) > r;
}

/// Points in a corridor over the number that would block it, by looking at every point.
double bruteForceLoad(const std::vector<PosedCloud>& clouds, const Config& config, const Pose& T_common_hand, double r)
{
  double load = 0.0;
  for (const PosedCloud& view : clouds) {
    const Pose T_hand_view = T_common_hand.inverse() * view.T_common_cloud;
    std::size_t points = 0;
    for (std::size_t i = 0; i < view.cloud->size(); ++i) {
      points += view.cloud->measured(i) && inCorridor(T_hand_view * view.cloud->point(i).cast<double>(), config, r);
    }
    double to_block = config.shell.gap_points_to_block * config.hand.palm_width / config.shell.clearance_length;
    if (view.cloud->intrinsics && config.shell.scale_with_density) {
      const double depth = (view.T_common_cloud.inverse() * T_common_hand.translation()).z();
      const double ratio = config.shell.reference_spacing * view.cloud->intrinsics->fx / depth;
      to_block *= ratio * ratio;
    }
    load += static_cast<double>(points) / std::max(2.0, to_block);
  }
  return load;
}

/// Distance (m) along a polyline to where it is nearest to a point.
double placeAlong(const Polyline& polyline, const Eigen::Vector3d& point)
{
  double least = std::numeric_limits<double>::infinity(), place = 0.0, before = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Eigen::Vector3d step = polyline[i] - polyline[i - 1];
    const double length = step.norm();
    const double along = std::clamp((point - polyline[i - 1]).dot(step) / length, 0.0, length);
    const double distance = (polyline[i - 1] + along / length * step - point).norm();
    if (distance < least) {
      least = distance;
      place = before + along;
    }
    before += length;
  }
  return place;
}

TEST(HandPoses, AreSortedByTheDocumentedScore)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config;
  config.hand_poses.min_observed_free = 0.0;
  config.shell.continue_surfaces = false;  // so that points are measured ones
  Localizer localizer(config);
  std::size_t judged = 0;
  for (const GraspHandle& handle : localizer.localize(cloud).handles) {
    const double length = lengthOf(handle.polyline);
    const std::vector<GraspPose> hands = search(cloud, config, handle);
    for (std::size_t i = 0; i < hands.size(); ++i) {
      const GraspPose& hand = hands[i];
      const double load =
          bruteForceLoad({{&cloud, Pose::Identity()}}, config, hand.pose, std::min(handle.inner_radius, 0.026));
      const double off = std::abs(placeAlong(handle.polyline, hand.pose.translation()) - length / 2) / (length / 2);
      // Along a bent handle the axis, and with it the normal, is another one at each place.
      const Eigen::Vector3d axis = hand.pose.linear().col(2);
      const Eigen::Vector3d normal = (handle.normal - handle.normal.dot(axis) * axis).normalized();
      const double expected =
          (hand.observed_free + 1 - load * load + (1 - approach(hand).dot(normal)) / 2 + 1 - off) / 4;
      EXPECT_NEAR(hand.score, expected, 1e-6);
      EXPECT_GE(hand.score, 0.0);
      EXPECT_LE(hand.score, 1.0);
      EXPECT_TRUE(i == 0 || hands[i - 1].score >= hand.score) << i;
      ++judged;
    }
  }
  EXPECT_GT(judged, 20U);
}

/// Where the sensor's place is not known, a handle has no normal: no side of it is better than another.
TEST(HandPoses, OfAHandleWithoutANormalAreScoredWithoutASide)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  const Cloud points = unorganized(cloud);
  Config config;
  std::size_t judged = 0;
  for (GraspHandle handle : Localizer(config).localize(cloud).handles) {
    handle.normal.setConstant(std::nan(""));
    const double length = lengthOf(handle.polyline);
    for (const GraspPose& hand : search(points, config, handle)) {
      ASSERT_TRUE(hand.pose.matrix().allFinite());
      EXPECT_NEAR(hand.pose.linear().determinant(), 1.0, 1e-9);
      const double load =
          bruteForceLoad({{&points, Pose::Identity()}}, config, hand.pose, std::min(handle.inner_radius, 0.026));
      const double off = std::abs(placeAlong(handle.polyline, hand.pose.translation()) - length / 2) / (length / 2);
      EXPECT_NEAR(hand.score, (1 - load * load + 1 - off) / 2, 1e-6);
      ++judged;
    }
    // With a direction of approach the hand comes from there all the same.
    Config from_above = config;
    from_above.hand_poses.approach_y = 1.0;
    from_above.hand_poses.max_approach_angle = 0.5;
    for (const GraspPose& hand : search(points, from_above, handle)) {
      EXPECT_GT(approach(hand).y(), std::cos(0.5) - 1e-6);
      EXPECT_TRUE(std::isfinite(hand.score));
    }
  }
  EXPECT_GT(judged, 20U);
}

/// With no free space asked for, a pose is there where the points in its corridor are too few, and nowhere else.
TEST(HandPoses, AreThoseWhoseCorridorBruteForceFindsClear)
{
  const View view = makeScene("table", 1), turned = viewFromAside(view, 1.0);
  const Cloud first = captureView(view, 1).cloud, second = captureView(turned, 2).cloud;
  const Cloud points = unorganized(first);
  const Pose T_first_second = view.T_scene_camera.inverse() * turned.T_scene_camera;
  const std::vector<std::vector<PosedCloud>> moments{
      {{&first, Pose::Identity()}},
      {{&points, Pose::Identity()}},
      {{&first, Pose::Identity()}, {&second, T_first_second}},
      {{&second, Pose(view.T_scene_camera * T_first_second)}, {&first, view.T_scene_camera}}};
  Config config;
  config.hand_poses.min_observed_free = 0.0;
  config.shell.continue_surfaces = false;
  for (std::size_t moment = 0; moment < moments.size(); ++moment) {
    SCOPED_TRACE(moment);
    const std::vector<PosedCloud>& clouds = moments[moment];
    Moment prepared(clouds, config);
    Random random(7);
    int clear = 0, blocked = 0;
    for (int round = 0; round < 40; ++round) {
      config.hand.palm_width = random.uniform(0.01, 0.06);
      config.hand.palm_depth = random.uniform(0.0, 0.1);
      config.hand_poses.approach_distance = random.uniform(0.0, 0.1);
      // About a measured point, or beside one.
      const Cloud& cloud = *clouds[0].cloud;
      std::size_t i = 0;
      do {
        i = static_cast<std::size_t>(random.uniform(0.0, 0.9999) * static_cast<double>(cloud.size()));
      } while (!cloud.measured(i) || cloud.point(i).z() > 1.0F);
      const GraspHandle handle =
          handleAt(clouds[0].T_common_cloud * cloud.point(i).cast<double>() + 0.03 * random.direction(),
                   random.direction(), random.direction(), random.uniform(0.005, 0.025), 0.01);
      const std::vector<GraspPose> hands = prepared.search(config, handle);
      for (int direction = 0; direction < config.hand_poses.count; ++direction) {
        const Pose T_common_hand = handFrom(handle, 2 * M_PI * direction / config.hand_poses.count);
        const double load = bruteForceLoad(clouds, config, T_common_hand, handle.inner_radius);
        EXPECT_EQ(findApproach(hands, T_common_hand.linear().col(0), handle.centroid).has_value(), load < 1.0)
            << "round " << round << ", direction " << direction << ", load " << load;
        ++(load < 1.0 ? clear : blocked);
      }
    }
    EXPECT_GT(clear, 50);
    EXPECT_GT(blocked, 50);
  }
}

/// Of points drawn evenly in a corridor, the share that a camera at the origin sees, or sees past.
double drawnFreeShare(const Cloud& cloud, const Config& config, const Pose& T_camera_hand, double r)
{
  std::string warning;
  const RangeImage image = *RangeImage::create(cloud, warning);
  Random random(3);
  int drawn = 0, free = 0;
  while (drawn < 5000) {
    const Vector p(random.uniform(-0.3, 0.0), random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05));
    if (inCorridor(p, config, r)) {
      const Vector point = T_camera_hand * p;
      const auto pixel = image.pixel(point);
      free += pixel && cloud.measured(*pixel) && cloud.point(*pixel).cast<double>().norm() > point.norm();
      ++drawn;
    }
  }
  return static_cast<double>(free) / drawn;
}

TEST(HandPoses, TellTheShareOfTheCorridorThatWasSeenThrough)
{
  const Cloud cloud = capture(barInFrontOfWall(1.0));
  const GraspHandle handle = barHandle();
  Config config;
  config.hand_poses.min_observed_free = 0.0;
  const std::vector<GraspPose> hands = search(cloud, config, handle);
  ASSERT_EQ(hands.size(), 12U) << "nothing is in the way";
  double least = 1.0;
  for (const GraspPose& hand : hands) {
    constexpr double kTolerance = 0.1;  // 96 points on a lattice of eight by four by three
    EXPECT_NEAR(hand.observed_free, drawnFreeShare(cloud, config, hand.pose, handle.inner_radius), kTolerance);
    least = std::min(least, hand.observed_free);
  }
  EXPECT_LT(least, 0.6) << "the bar hides what is behind it";

  config.hand_poses.min_observed_free = 0.75;
  const std::vector<GraspPose> seen = search(cloud, config, handle);
  EXPECT_LT(seen.size(), hands.size());
  EXPECT_EQ(
      static_cast<std::ptrdiff_t>(seen.size()),
      std::count_if(hands.begin(), hands.end(), [](const GraspPose& hand) { return hand.observed_free >= 0.75; }));
}

TEST(HandPoses, NoneWhereNothingIsSeenBehind)
{
  Scene scene;
  scene.beginObject("bar");
  scene.add(Cylinder{0.01, 0.3}, halfway(Vector(-0.15, 0.0, 0.8), Vector(0.15, 0.0, 0.8)));
  const Cloud cloud = capture(scene);
  Config config;
  const std::vector<GraspPose> hands = search(cloud, config, barHandle());
  for (const GraspPose& hand : hands) {
    EXPECT_GE(hand.observed_free, config.hand_poses.min_observed_free) << "in front of the bar itself";
  }
  EXPECT_LT(hands.size(), 4U);
  config.hand_poses.min_observed_free = 0.0;
  EXPECT_EQ(search(cloud, config, barHandle()).size(), 12U);
}

TEST(HandPoses, OfABarOnPostsComeFromAboveUnlessABoxIsThere)
{
  MountedBar bar;
  bar.axis_height = 0.1;
  TableTop open, covered;
  add(open.scene, Pose::Identity(), bar);
  add(covered.scene, Pose::Identity(), bar);
  covered.scene.beginObject("box");
  covered.scene.add(Box{{0.3, 0.03, 0.02}}, at(0.0, 0.0, 0.2));
  const GraspHandle handle =
      handleAt(Vector(0.0, 0.0, 0.1), Vector::UnitX(), Vector(0.0, -0.5, 0.5), bar.radius + 0.002, 0.05);

  Config config;
  config.hand_poses.min_observed_free = 0.2;
  const auto hands = search(capture(open.scene, open.T_scene_camera), config, open.inCamera(handle));
  const auto below = search(capture(covered.scene, covered.T_scene_camera), config, covered.inCamera(handle));
  constexpr double kSomeWay = 0.5;
  EXPECT_TRUE(open.anyFrom(hands, -Vector::UnitZ(), kSomeWay)) << "from above";
  EXPECT_TRUE(open.anyFrom(hands, Vector::UnitY(), kSomeWay)) << "from the front";
  EXPECT_FALSE(open.anyFrom(hands, Vector::UnitZ(), kSomeWay)) << "through the table";
  EXPECT_FALSE(covered.anyFrom(below, -Vector::UnitZ(), kSomeWay)) << "through the box";
  EXPECT_TRUE(covered.anyFrom(below, Vector::UnitY(), kSomeWay)) << "from the front, below the box";
}

TEST(HandPoses, SurfacesThatGoOnUnseenBlockThem)
{
  // A plate hides a part of a wall, and what is between them.
  Scene scene;
  scene.beginObject("plate");
  scene.add(Box{{0.08, 0.08, 0.004}}, at(0.0, 0.0, 0.7));
  scene.beginObject("wall");
  scene.add(Box{{4.0, 4.0, 0.1}}, at(0.0, 0.0, 0.83 + 0.05));
  const Cloud cloud = capture(scene);
  const GraspHandle handle = handleAt(Vector(0.0, 0.0, 0.78), Vector::UnitX(), -Vector::UnitZ(), 0.01, 0.05);
  const Vector from_behind = -Vector::UnitZ();
  Config config;
  config.hand_poses.min_observed_free = 0.0;
  EXPECT_FALSE(findApproach(search(cloud, config, handle), from_behind, handle.centroid));
  config.shell.continue_surfaces = false;
  EXPECT_TRUE(findApproach(search(cloud, config, handle), from_behind, handle.centroid));
}

TEST(HandPoses, WhatOneOfSeveralViewsSawThroughIsFreeAndWhatOneSawBlocks)
{
  // A second camera on the other side of the bar, and a third that sees it from there, too, with a box in between.
  Scene scene = barInFrontOfWall(3.0);
  const Pose T_behind = Eigen::Translation3d(0.0, 0.0, 1.6) * Eigen::AngleAxisd(M_PI, Vector::UnitY());
  Scene from_behind = barInFrontOfWall(3.0);
  from_behind.beginObject("wall in front");
  from_behind.add(Box{{4.0, 4.0, 0.1}}, at(0.0, 0.0, -1.05));
  Scene with_box = from_behind;
  with_box.beginObject("box");
  with_box.add(Box{{0.3, 0.05, 0.01}}, at(0.0, 0.0, 0.9));
  const Cloud front = capture(scene), behind = capture(from_behind, T_behind), box = capture(with_box, T_behind);
  const GraspHandle handle = barHandle();
  const Vector to_front = -Vector::UnitZ();
  Config config;
  config.hand_poses.min_observed_free = 0.75;
  EXPECT_FALSE(findApproach(search(front, config, handle), to_front, handle.centroid));
  const auto both = search({{&front, Pose::Identity()}, {&behind, T_behind}}, config, handle);
  const auto hand = findApproach(both, to_front, handle.centroid);
  ASSERT_TRUE(hand);
  EXPECT_EQ(hand->observed_free, 1.0);
  config.hand_poses.min_observed_free = 0.0;
  EXPECT_FALSE(
      findApproach(search({{&front, Pose::Identity()}, {&box, T_behind}}, config, handle), to_front, handle.centroid));
}

}  // namespace
}  // namespace grasp_affordances::test
