#include "grasp_affordances/localizer.h"

#include "core/hand_poses/hand_pose_search.h"
#include "core/parallel/thread_team.h"
#include "core/views/prepared_views.h"
#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/sensor.h"
#include "simulation/tableware.h"
#include "support/points.h"
#include "support/same_bits.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Pose = Eigen::Isometry3d;
using Vector = Eigen::Vector3d;

XtionModel exactSensor()
{
  XtionModel model;
  model.exact = true;
  return model;
}

Cloud capture(const Scene& scene, const Pose& T_scene_camera = Pose::Identity())
{
  return Xtion(exactSensor()).capture(scene, T_scene_camera, 1).cloud;
}

Cloud unorganized(Cloud cloud)
{
  cloud.width *= cloud.height;
  cloud.height = 1;
  cloud.intrinsics.reset();
  return cloud;
}

/// A straight handle with its middle at a point.
GraspHandle handleAt(const Vector& centroid, const Vector& axis, const Vector& normal, double inner_radius,
                     double length)
{
  GraspHandle handle;
  handle.centroid = centroid;
  handle.axis = axis.normalized();
  handle.normal = (normal - normal.dot(handle.axis) * handle.axis).normalized();
  handle.radius = handle.inner_radius = inner_radius;
  handle.length = length;
  handle.polyline = {centroid - length / 2 * handle.axis, centroid + length / 2 * handle.axis};
  return handle;
}

/// Clouds of one moment, prepared once for many searches.
class Moment
{
public:
  Moment(const std::vector<PosedCloud>& clouds, const Config& config)
  {
    ThreadTeam team(1);
    views_.update(clouds, config, Pose::Identity(), team);
  }

  std::vector<GraspPose> search(const Config& config, GraspHandle handle,
                                const Pose& T_approach_common = Pose::Identity())
  {
    search_.search(views_, config, T_approach_common, handle);
    return handle.hand_poses;
  }

private:
  PreparedViews views_;
  HandPoseSearch search_;
};

std::vector<GraspPose> search(const std::vector<PosedCloud>& clouds, const Config& config, const GraspHandle& handle)
{
  return Moment(clouds, config).search(config, handle);
}

std::vector<GraspPose> search(const Cloud& cloud, const Config& config, const GraspHandle& handle,
                              const Pose& T_approach_common = Pose::Identity())
{
  return Moment({{&cloud, Pose::Identity()}}, config).search(config, handle, T_approach_common);
}

Vector approach(const GraspPose& hand)
{
  return hand.pose.linear().col(0);
}

/// The pose among some whose approach is a direction (within 1e-6), at a point.
std::optional<GraspPose> findApproach(const std::vector<GraspPose>& hands, const Vector& direction, const Vector& at)
{
  for (const GraspPose& hand : hands) {
    if ((approach(hand) - direction.normalized()).norm() < 1e-6 && (hand.pose.translation() - at).norm() < 1e-9) {
      return hand;
    }
  }
  return std::nullopt;
}

bool sameBytes(const std::vector<GraspPose>& a, const std::vector<GraspPose>& b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const GraspPose& x, const GraspPose& y) {
           return x.pose.matrix() == y.pose.matrix() && x.width == y.width && x.score == y.score &&
                  sameBits(x.observed_free, y.observed_free);
         });
}

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

/// A hand that comes from a direction on a handle's ring, by angle from the normal.
Pose handFrom(const GraspHandle& handle, double angle)
{
  const Vector radial = std::cos(angle) * handle.normal + std::sin(angle) * handle.axis.cross(handle.normal);
  Pose T_common_hand;
  T_common_hand.linear() << -radial, handle.axis.cross(-radial), handle.axis;
  T_common_hand.translation() = handle.centroid;
  return T_common_hand;
}

/// A bar along x, 0.8 m in front of the camera, whose frame is the scene's; and a wall so far behind it.
Scene barInFrontOfWall(double distance, double radius = 0.01)
{
  Scene scene;
  scene.beginObject("bar");
  scene.add(Cylinder{radius, 0.3}, halfway(Vector(-0.15, 0.0, 0.8), Vector(0.15, 0.0, 0.8)));
  scene.beginObject("wall");
  scene.add(Box{{4.0, 4.0, 0.1}}, at(0.0, 0.0, 0.8 + distance + 0.05));
  return scene;
}

GraspHandle barHandle()
{
  return handleAt(Vector(0.0, 0.0, 0.8), Vector::UnitX(), -Vector::UnitZ(), 0.012, 0.05);
}

TEST(HandPoses, FrontOfAFreeBarIsOpenToAHand)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  const GraspHandle handle = barHandle();
  const Config config;
  const std::vector<GraspPose> hands = search(cloud, config, handle);
  ASSERT_GE(hands.size(), 7U);
  const GraspPose& best = hands.front();
  EXPECT_LT((approach(best) - Vector::UnitZ()).norm(), 1e-12) << "from the sensor's side";
  EXPECT_EQ(best.observed_free, 1.0);
  EXPECT_NEAR(best.score, 1.0, 1e-12);
  for (const GraspPose& hand : hands) {
    EXPECT_EQ(hand.pose.linear().col(2), handle.axis) << "z along the axis";
    EXPECT_LT((hand.pose.linear().transpose() * hand.pose.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(hand.pose.linear().determinant(), 1.0, 1e-12);
    EXPECT_EQ(hand.pose.translation(), handle.centroid);
    EXPECT_EQ(hand.width, 2 * handle.inner_radius);
  }
  // The wall is far enough away for a hand that comes between it and the bar, on both sides.
  for (const int i : {1, 2, 3, 9, 10, 11}) {
    EXPECT_TRUE(findApproach(hands, handFrom(handle, i * M_PI / 6).linear().col(0), handle.centroid)) << i;
  }
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

/// Seen from above at a slant. Scene frame: z up from the table's top.
struct TableTop
{
  TableTop()
  {
    scene.beginObject("table");
    scene.add(Box{{1.6, 1.2, 0.03}}, at(0.0, 0.25, -0.015));
    T_scene_camera = lookAt(Vector(0.0, -0.5, 0.6), Vector(0.0, 0.0, 0.1));
  }

  /// A handle given in the scene, in the camera's frame.
  GraspHandle inCamera(GraspHandle handle) const { return transformed(std::move(handle), T_scene_camera.inverse()); }

  bool anyFrom(const std::vector<GraspPose>& hands, const Vector& approach_scene, double max_angle) const
  {
    return std::any_of(hands.begin(), hands.end(), [&](const GraspPose& hand) {
      return (T_scene_camera.linear() * approach(hand)).dot(approach_scene) > std::cos(max_angle);
    });
  }

  Scene scene;
  Pose T_scene_camera;
};

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

TEST(HandPoses, OfUnorganizedCloudsDependOnPointsAloneAndNotOnTheirOrder)
{
  Cloud cloud = unorganized(captureScene("table", 1).cloud);
  Config config;
  config.hand_poses.min_observed_free = 1.0;
  const Localization found = Localizer(config).localize(cloud);
  ASSERT_GT(found.handles.size(), 0U);
  std::vector<std::vector<GraspPose>> expected;
  std::size_t poses = 0;
  Moment in_order({{&cloud, Pose::Identity()}}, config);
  for (const GraspHandle& handle : found.handles) {
    expected.push_back(in_order.search(config, handle));
    poses += expected.back().size();
    for (const GraspPose& hand : expected.back()) {
      EXPECT_TRUE(std::isnan(hand.observed_free));
      EXPECT_GE(hand.score, 0.0);
    }
  }
  ASSERT_GT(poses, 0U);
  Random random(5);
  for (std::size_t i = cloud.size() - 1; i > 0; --i) {
    const auto j = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)));
    std::swap(cloud.x[i], cloud.x[j]);
    std::swap(cloud.y[i], cloud.y[j]);
    std::swap(cloud.z[i], cloud.z[j]);
  }
  Moment shuffled({{&cloud, Pose::Identity()}}, config);
  for (std::size_t i = 0; i < found.handles.size(); ++i) {
    EXPECT_TRUE(sameBytes(shuffled.search(config, found.handles[i]), expected[i])) << "handle " << i;
  }
}

TEST(HandPoses, KeepWithinTheConeOfApproach)
{
  TableTop top;
  add(top.scene, Pose::Identity(), MountedBar());
  const Cloud cloud = capture(top.scene, top.T_scene_camera);
  const GraspHandle handle =
      top.inCamera(handleAt(Vector(0.0, 0.0, 0.07), Vector::UnitX(), Vector(0.0, -0.5, 0.37), 0.0135, 0.05));
  Config config;
  config.hand_poses.approach_z = -0.5;  // from above: z of the scene points up; need not be a unit vector
  for (const double max_angle : {0.0, 0.6, 1.2}) {
    config.hand_poses.max_approach_angle = max_angle;
    const auto hands = search(cloud, config, handle, top.T_scene_camera);
    ASSERT_GT(hands.size(), 0U) << max_angle;
    for (const GraspPose& hand : hands) {
      const Vector in_scene = top.T_scene_camera.linear() * approach(hand);
      EXPECT_LE(std::acos(std::min(1.0, -in_scene.z())), max_angle + 1e-4) << max_angle;
    }
    EXPECT_NEAR((top.T_scene_camera.linear() * approach(hands.front())).z(), -1.0, 1e-9) << "straight from above";
  }
  // From below, no hand.
  config.hand_poses.approach_z = 1.0;
  EXPECT_EQ(search(cloud, config, handle, top.T_scene_camera).size(), 0U);
  // All of a ring about the direction itself are at right angles to it.
  config.hand_poses.approach_z = -1.0;
  config.hand_poses.max_approach_angle = 1.5;
  const GraspHandle upright = top.inCamera(handleAt(Vector(0, 0, 0.25), Vector::UnitZ(), -Vector::UnitY(), 0.01, 0.05));
  EXPECT_EQ(search(cloud, config, upright, top.T_scene_camera).size(), 0U);
  config.hand_poses.max_approach_angle = 1.6;
  EXPECT_GT(search(cloud, config, upright, top.T_scene_camera).size(), 0U);
}

TEST(HandPoses, AreThoseOfTheTool)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  const auto hands = search(cloud, config, barHandle());
  config.hand_poses.tool_x = -0.18;
  config.hand_poses.tool_y = 0.01;
  config.hand_poses.tool_z = 0.02;
  config.hand_poses.tool_roll = 0.3;
  config.hand_poses.tool_pitch = -0.4;
  config.hand_poses.tool_yaw = 1.2;
  const auto tools = search(cloud, config, barHandle());
  // Roll, pitch and yaw about fixed axes, as in URDF: the columns of Rz(yaw) Ry(pitch) Rx(roll), written out.
  const double cr = std::cos(0.3), sr = std::sin(0.3), cp = std::cos(-0.4), sp = std::sin(-0.4), cy = std::cos(1.2),
               sy = std::sin(1.2);
  Pose T_hand_tool = at(-0.18, 0.01, 0.02);
  T_hand_tool.linear() << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,                      //
      -sp, cp * sr, cp * cr;
  ASSERT_EQ(tools.size(), hands.size());
  for (std::size_t i = 0; i < hands.size(); ++i) {
    EXPECT_LT((tools[i].pose.matrix() - (hands[i].pose * T_hand_tool).matrix()).norm(), 1e-12);
    EXPECT_EQ(tools[i].score, hands[i].score);
    EXPECT_EQ(tools[i].width, hands[i].width);
  }
}

TEST(HandPoses, OfLongHandlesAreAtSeveralPlaces)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  const auto offsetsOn = [&](double length) {
    GraspHandle handle = barHandle();
    handle.length = length;
    // Against the axis.
    handle.polyline = {handle.centroid + length / 2 * handle.axis, handle.centroid - length / 2 * handle.axis};
    std::vector<double> offsets;
    for (const GraspPose& hand : search(cloud, config, handle)) {
      EXPECT_EQ(hand.pose.linear().col(2), handle.axis);
      if (approach(hand).z() > 0.999) {
        EXPECT_LT((hand.pose.translation() - handle.centroid).tail<2>().norm(), 1e-12);
        offsets.push_back(hand.pose.translation().x());
      }
    }
    EXPECT_NEAR(offsets.front(), 0.0, 1e-12) << "the middle is best";
    std::sort(offsets.begin(), offsets.end());
    return offsets;
  };
  const auto expect = [](const std::vector<double>& actual, const std::vector<double>& expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i) {
      EXPECT_NEAR(actual[i], expected[i], 1e-9) << i;
    }
  };
  config.hand.palm_width = 0.03;
  expect(offsetsOn(0.05), {0.0});
  expect(offsetsOn(0.07), {-0.02, 0.0, 0.02});
  expect(offsetsOn(0.09), {-0.03, -0.015, 0.0, 0.015, 0.03});
  expect(offsetsOn(0.25), {-0.11, -0.055, 0.0, 0.055, 0.11});
}

TEST(HandPoses, OfABentHandleFollowIt)
{
  // An arc of 180 degrees about the line of sight, and its axis as a polyline of 13 points.
  constexpr double kArc = 0.06;
  Scene arc;
  arc.beginObject("arc");
  arc.add(TorusArc{kArc, 0.008, M_PI / 2}, at(0.0, 0.0, 0.8));
  arc.beginObject("wall");
  arc.add(Box{{4.0, 4.0, 0.1}}, at(0.0, 0.0, 1.5));
  GraspHandle handle = handleAt(Vector(kArc, 0.0, 0.8), Vector::UnitY(), -Vector::UnitZ(), 0.012, M_PI * kArc);
  handle.polyline.clear();
  for (int i = 0; i <= 12; ++i) {
    const double angle = M_PI / 2 - M_PI * i / 12;  // against the axis
    handle.polyline.emplace_back(kArc * std::cos(angle), kArc * std::sin(angle), 0.8);
  }
  Config config;
  const auto hands = search(capture(arc), config, handle);
  std::vector<Vector> places;
  for (const GraspPose& hand : hands) {
    const Vector p = hand.pose.translation() - Vector(0.0, 0.0, 0.8);
    EXPECT_NEAR(p.norm(), kArc, 0.001) << "on the arc";
    const Vector tangent = Vector::UnitZ().cross(p).normalized();
    EXPECT_LT(std::acos(std::min(1.0, hand.pose.linear().col(2).dot(tangent))), 0.05) << "along it, one way";
    EXPECT_NEAR(hand.pose.linear().col(0).dot(hand.pose.linear().col(2)), 0.0, 1e-12);
    if (std::none_of(places.begin(), places.end(), [&](const Vector& place) { return (place - p).norm() < 1e-9; })) {
      places.push_back(p);
    }
  }
  EXPECT_EQ(places.size(), 5U);
  EXPECT_LT((hands.front().pose.translation() - handle.centroid).norm(), 1e-12);
}

TEST(HandPoses, AreNoWiderThanTheHandOpens)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  GraspHandle handle = barHandle();
  handle.inner_radius = 2 * config.hand.capture_radius;
  const auto hands = search(cloud, config, handle);
  ASSERT_GT(hands.size(), 0U);
  EXPECT_EQ(hands.front().width, 2 * config.hand.capture_radius);
}

TEST(HandPoses, NoneIfNoneAreAskedForAndOldOnesAreGone)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  config.hand_poses.count = 0;
  GraspHandle handle = barHandle();
  handle.hand_poses.resize(3);
  EXPECT_EQ(search(cloud, config, handle).size(), 0U);
  config.hand_poses.count = 1;
  EXPECT_EQ(search(cloud, config, handle).size(), 1U);
}

TEST(HandPoses, AreTheSameForAnyNumberOfThreadsAndWhateverCameBefore)
{
  const Cloud cloud = captureScene("table", 1).cloud, other = captureScene("mugs", 2).cloud;
  Config config;
  config.threads = 1;
  const Localization reference = Localizer(config).localize(cloud);
  std::size_t poses = 0;
  for (const int threads : {1, 2, 5}) {
    config.threads = threads;
    Localizer localizer(config);
    localizer.localize(other);
    const Localization result = localizer.localize(cloud);
    ASSERT_EQ(result.handles.size(), reference.handles.size());
    for (std::size_t i = 0; i < result.handles.size(); ++i) {
      EXPECT_TRUE(sameBytes(result.handles[i].hand_poses, reference.handles[i].hand_poses)) << threads << ", " << i;
      poses += result.handles[i].hand_poses.size();
    }
  }
  EXPECT_GT(poses, 0U);
}

TEST(HandPoses, MoveWithTheCommonFrame)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  const Config config;
  const Pose T = at(0.3, -0.2, 0.9) * turned(0.8, Vector(1.0, 2.0, -0.5).normalized());
  for (const GraspHandle& handle : Localizer(config).localize(cloud).handles) {
    const GraspHandle moved = transformed(handle, T);
    const bool flipped = moved.axis.dot(T.linear() * handle.axis) < 0.0;  // its other direction may stand for it now
    const auto hands = search(cloud, config, handle);
    const auto posed = search({{&cloud, T}}, config, moved);
    ASSERT_EQ(posed.size(), hands.size());
    for (const GraspPose& hand : hands) {
      const auto found = findApproach(posed, T.linear() * approach(hand), T * hand.pose.translation());
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->score, hand.score, 0.02) << flipped;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
