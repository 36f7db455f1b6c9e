#include "simulation/grip_labels.h"
#include "support/grips.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

/// A half-space that ends at `distance` from the z axis towards +x.
Eigen::Isometry3d wallAt(double distance)
{
  return at(distance, 0.0, 0.0) * Eigen::AngleAxisd(-0.5 * kPi, Eigen::Vector3d::UnitY());
}

/// The label in the middle of a solid that stands alone.
std::uint32_t labelOf(const Primitive& solid, double margin = 0.0)
{
  Scene scene;
  scene.add(solid, Eigen::Isometry3d::Identity());
  return label(scene, margin).label(0, Eigen::Vector3d::Zero());
}

// Bars with the given clearance.

Scene barAbovePlate(double clearance)
{
  Scene scene;
  scene.add(Cylinder{0.01, 0.1}, lying(0.0, 0.0, 0.01 + clearance));
  scene.add(Box{{0.3, 0.3, 0.02}}, at(0.0, 0.0, -0.01));
  return scene;
}

Scene barBesideWall(double clearance)
{
  Scene scene;
  scene.add(Cylinder{0.01, 0.1}, Eigen::Isometry3d::Identity());
  scene.add(HalfSpace{}, wallAt(0.01 + clearance));
  return scene;
}

Scene barInTube(double clearance)
{
  Scene scene;
  scene.add(Cylinder{0.01, 0.1}, Eigen::Isometry3d::Identity());
  scene.add(Cylinder{0.02 + clearance, 0.1, 0.01}, Eigen::Isometry3d::Identity());
  return scene;
}

Scene barBesideBar(double clearance)
{
  Scene scene;
  scene.add(Cylinder{0.01, 0.1}, Eigen::Isometry3d::Identity());
  scene.add(Cylinder{0.03, 0.2}, at(0.0, 0.04 + clearance, 0.0));
  return scene;
}

TEST(GripLabels, ClearanceIsThatOfTheNearestSolidOnAnySide)
{
  for (const auto make : {barAbovePlate, barBesideWall, barInTube, barBesideBar}) {
    const auto labelWith = [&](double clearance, double margin) {
      return label(make(clearance), margin).label(0, Eigen::Vector3d::Zero());
    };
    EXPECT_EQ(labelWith(0.007, 0.0), kNotGraspable);
    EXPECT_EQ(labelWith(0.009, 0.0), 1U);
    EXPECT_EQ(labelWith(0.0079, 0.0), kNotGraspable);
    EXPECT_EQ(labelWith(0.0081, 0.0), 1U);
    EXPECT_EQ(labelWith(0.0074, 0.0005), kNotGraspable);
    EXPECT_EQ(labelWith(0.0076, 0.0005), kDoubtful);
    EXPECT_EQ(labelWith(0.0084, 0.0005), kDoubtful);
    EXPECT_EQ(labelWith(0.0086, 0.0005), 1U);
  }
}

TEST(GripLabels, RadiusIsLessThanTheCaptureRadius)
{
  EXPECT_EQ(labelOf(Cylinder{0.025, 0.1}), 1U);
  EXPECT_EQ(labelOf(Cylinder{0.027, 0.1}), kNotGraspable);
  EXPECT_EQ(labelOf(Cylinder{0.025, 0.1}, 0.0015), kDoubtful);
  EXPECT_EQ(labelOf(Cylinder{0.027, 0.1}, 0.0015), kDoubtful);
  EXPECT_EQ(labelOf(Cylinder{0.024, 0.1}, 0.0015), 1U);
  EXPECT_EQ(labelOf(Cylinder{0.028, 0.1}, 0.0015), kNotGraspable);
  EXPECT_EQ(labelOf(Cylinder{0.04, 0.2, 0.03}), kNotGraspable) << "the outside of a tube counts, not its bore";
}

TEST(GripLabels, LengthIsAtLeastTheMinimum)
{
  EXPECT_EQ(labelOf(Cylinder{0.01, 0.025}), kNotGraspable);
  EXPECT_EQ(labelOf(Cylinder{0.01, 0.035}), 1U);
  EXPECT_EQ(labelOf(Cylinder{0.01, 0.025}, 0.006), kDoubtful);
  EXPECT_EQ(labelOf(Cylinder{0.01, 0.035}, 0.006), kDoubtful);
  EXPECT_EQ(labelOf(Cylinder{0.01, 0.023}, 0.006), kNotGraspable);
  EXPECT_EQ(labelOf(Cylinder{0.01, 0.037}, 0.006), 1U);
}

TEST(GripLabels, OfATaperedPartOnlyTheSlimStretchCounts)
{
  // The radius is 2.6 cm at 3.3 cm above the bottom; eight cells of 11 cm / 28 end below that.
  Scene scene;
  scene.add(Frustum{0.02, 0.04, 0.11}, at(0.0, 0.0, 0.055));
  const GripLabels labels = label(scene);
  ASSERT_EQ(labels.grips().size(), 1U);
  const Grip& grip = labels.grips().front();
  const double length = 0.11 * 8 / 28;
  EXPECT_NEAR(grip.length, length, 1e-12);
  EXPECT_NEAR(grip.radius, 0.02 + 0.02 * length / 0.11, 1e-12);
  EXPECT_TRUE(grip.axis.front().isZero(1e-12));
  EXPECT_TRUE(grip.axis.back().isApprox(Eigen::Vector3d(0.0, 0.0, length)));
  for (double z = 0.0005; z < 0.11; z += 0.001)
    EXPECT_EQ(labels.label(0, Eigen::Vector3d(0.03, 0.0, z - 0.055)), z < length ? 1U : kNotGraspable) << z;

  EXPECT_EQ(label(scene, 0.002).grips().size(), 0U) << "1.4 mm of length to spare";
  Scene short_scene;
  short_scene.add(Frustum{0.02, 0.04, 0.1}, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(label(short_scene).grips().empty()) << "2.6 cm at 3 cm, so that seven cells of 4 mm count";
}

Scene bottle(bool joined)
{
  Scene scene;
  scene.beginObject("bottle");
  scene.add(Cylinder{0.035, 0.1}, at(0.0, 0.0, 0.05));
  const std::size_t cap = scene.add(Cylinder{0.016, 0.02}, at(0.0, 0.0, 0.13));
  const std::size_t neck = scene.add(Cylinder{0.014, 0.02}, at(0.0, 0.0, 0.11));
  if (joined)
    scene.join({neck, cap});
  return scene;
}

TEST(GripLabels, ShortNeckAndShortCapAreLongEnoughWhenJoined)
{
  EXPECT_TRUE(label(bottle(false)).grips().empty());
  const GripLabels labels = label(bottle(true));
  ASSERT_EQ(labels.grips().size(), 1U);
  EXPECT_NEAR(labels.grips()[0].length, 0.04, 1e-12);
  EXPECT_NEAR(labels.grips()[0].radius, 0.016, 1e-12);
  EXPECT_EQ(labels.grips()[0].parts, (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(labels.label(0, {0.035, 0.0, 0.049}), kNotGraspable);
  EXPECT_EQ(labels.label(1, {0.0, 0.0, 0.01}), 1U) << "the end of the cap";
  EXPECT_EQ(labels.label(2, {0.014, 0.0, -0.0099}), 1U);
}

TEST(GripLabels, AStretchInsideAnEarlierPartOfTheChainAddsNoLength)
{
  const auto gripsWithOverlap = [](double overlap) {
    Scene scene;
    const std::size_t lower = scene.add(Cylinder{0.014, 0.02}, at(0.0, 0.0, 0.01));
    const std::size_t upper = scene.add(Cylinder{0.016, 0.02}, at(0.0, 0.0, 0.03 - overlap));
    scene.join({lower, upper});
    return label(scene).grips().size();
  };
  EXPECT_EQ(gripsWithOverlap(0.008), 1U);  // 3.2 cm
  EXPECT_EQ(gripsWithOverlap(0.012), 0U);  // 2.8 cm
}

TEST(GripLabels, StraightsAndArcOfAHandleAreOneGrip)
{
  const double radius = 0.04, straight = 0.03;
  for (const bool upside_down : {false, true}) {
    Scene scene;
    scene.beginObject("kettle");
    scene.add(Cylinder{0.08, 0.1}, at(0.0, 0.0, 0.05));
    const double middle = 0.1 + 0.5 * straight;
    const Eigen::AngleAxisd turn(upside_down ? kPi : 0.0, Eigen::Vector3d::UnitY());
    const std::size_t left = scene.add(Cylinder{0.008, straight}, at(-radius, 0.0, middle) * turn);
    const std::size_t right = scene.add(Cylinder{0.008, straight}, at(radius, 0.0, middle));
    Eigen::Isometry3d T_scene_arc = at(0.0, 0.0, 0.1 + straight);
    T_scene_arc.linear() << Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY();
    const std::size_t arc = scene.add(TorusArc{radius, 0.008, 0.5 * kPi}, T_scene_arc);
    scene.join({left, arc, right});

    const GripLabels labels = label(scene);
    ASSERT_EQ(labels.grips().size(), 1U);
    const Grip& grip = labels.grips().front();
    EXPECT_NEAR(grip.length, kPi * radius + 2.0 * straight, 1e-12);
    for (const std::size_t part : {left, right, arc})
      EXPECT_EQ(labels.label(part, Eigen::Vector3d::Zero()), 1U);
    EXPECT_TRUE(grip.axis.front().isApprox(Eigen::Vector3d(-radius, 0.0, 0.1)));
    EXPECT_TRUE(grip.axis.back().isApprox(Eigen::Vector3d(radius, 0.0, 0.1)));
    for (std::size_t i = 1; i < grip.axis.size(); ++i)
      EXPECT_NEAR((grip.axis[i] - grip.axis[i - 1]).norm(), 0.004, 0.0005) << "point " << i;
  }
}

// The clearance of a mug's handle, recomputed by marching, is enough wherever it has a label, and is not somewhere
// within a cell wherever it has none.
TEST(GripLabels, HandleOfAMugIsLabelledWhereItIsClearOfTheMug)
{
  const double mug_radius = 0.04, mug_height = 0.1;
  const TorusArc arc{0.035, 0.007, 0.58 * kPi};
  Scene scene;
  scene.beginObject("mug");
  scene.add(Cylinder{mug_radius, mug_height, 0.004}, Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T_mug_arc = at(0.045, 0.0, 0.0) * Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX());
  scene.add(arc, T_mug_arc);
  const GripLabels labels = label(scene);
  ASSERT_EQ(labels.grips().size(), 1U);
  EXPECT_EQ(labels.label(0, {mug_radius, 0.0, 0.0}), kNotGraspable);

  const auto clearance = [&](double angle) {
    const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
    double least = 0.02;
    for (int degree = 0; degree < 360; ++degree) {
      const double around = degree * kPi / 180.0;
      const Eigen::Vector3d direction = std::cos(around) * outwards + std::sin(around) * Eigen::Vector3d::UnitZ();
      for (double t = 0.0; t < least; t += 0.0001) {
        const Eigen::Vector3d p = T_mug_arc * (arc.major_radius * outwards + (arc.tube_radius + t) * direction);
        if (std::abs(p.z()) < 0.5 * mug_height && p.head<2>().norm() < mug_radius)
          least = t;
      }
    }
    return least;
  };
  const double step = 0.01;
  const double cell = 0.0045 / arc.major_radius;
  std::vector<std::pair<double, double>> clearances;
  for (double angle = -arc.half_angle; angle < arc.half_angle; angle += step)
    clearances.emplace_back(angle, clearance(angle));
  int labelled = 0;
  for (const auto& [angle, clear] : clearances) {
    const Eigen::Vector3d on_axis(arc.major_radius * std::cos(angle), arc.major_radius * std::sin(angle), 0.0);
    if (labels.label(1, on_axis) == 1) {
      ++labelled;
      EXPECT_GE(clear, kDefinition.clearance - 0.0007) << "a sixth of a cell lies beyond the outermost section";
    } else {
      EXPECT_TRUE(std::any_of(clearances.begin(), clearances.end(), [&, place = angle](const auto& near) {
        return std::abs(near.first - place) < cell && near.second < kDefinition.clearance + 0.0001;
      })) << angle;
    }
  }
  EXPECT_NEAR(labelled * step * arc.major_radius, labels.grips()[0].length, 0.001);
  EXPECT_LT(labels.grips()[0].length, 2.0 * arc.half_angle * arc.major_radius - 0.01);
}

TEST(GripLabels, ASlimBarWithFlatSidesIsDoubtful)
{
  EXPECT_EQ(labelOf(Box{{0.2, 0.03, 0.03}}), kDoubtful);        // half-diagonal 2.1 cm
  EXPECT_EQ(labelOf(Box{{0.04, 0.04, 0.2}}), kNotGraspable);    // 2.8 cm
  EXPECT_EQ(labelOf(Box{{0.02, 0.028, 0.02}}), kNotGraspable);  // too short
  Scene near_wall;
  near_wall.add(Box{{0.03, 0.03, 0.2}}, Eigen::Isometry3d::Identity());
  near_wall.add(HalfSpace{}, wallAt(0.015 + 0.007));
  EXPECT_EQ(label(near_wall).label(0, Eigen::Vector3d::Zero()), kNotGraspable);
}

TEST(GripLabels, AnEllipticSectionMustNotBeFlat)
{
  EXPECT_EQ(labelOf(EllipticCylinder{0.015, 0.012, 0.1}), 1U);
  EXPECT_EQ(labelOf(EllipticCylinder{0.02, 0.024, 0.1}), kDoubtful);  // 2.88 cm at the flat side
  EXPECT_EQ(labelOf(EllipticCylinder{0.027, 0.02, 0.1}), kNotGraspable);
  Scene near_wall;
  near_wall.add(EllipticCylinder{0.015, 0.012, 0.1}, Eigen::Isometry3d::Identity());
  near_wall.add(HalfSpace{}, wallAt(0.0235));
  EXPECT_EQ(label(near_wall).grips().size(), 1U) << "8.5 mm beyond the end of the long axis";
}

double radiusOf(const Primitive& solid)
{
  const std::vector<Grip> grips = gripsOfSolid(solid, Eigen::Isometry3d::Identity());
  return grips.size() == 1 ? grips.front().radius : 0.0;
}

TEST(GripLabels, RoundedBoxIsHeldIfTheCircleAroundItsSectionFits)
{
  const auto grip = [](double corner_radius) { return Primitive(RoundedBox{{0.04, 0.028, 0.1}, corner_radius}); };
  EXPECT_NEAR(radiusOf(grip(0.0)), std::hypot(0.02, 0.014), 1e-12);             // 24.41 mm
  EXPECT_NEAR(radiusOf(grip(0.006)), std::hypot(0.014, 0.008) + 0.006, 1e-12);  // 22.12 mm
  EXPECT_NEAR(radiusOf(grip(0.014)), 0.02, 1e-12);
  EXPECT_EQ(labelOf(grip(0.0)), 1U);
  EXPECT_EQ(labelOf(grip(0.0), 0.0015), 1U);
  EXPECT_EQ(labelOf(grip(0.0), 0.0017), kDoubtful) << "1.59 mm to spare";
  EXPECT_EQ(labelOf(RoundedBox{{0.044, 0.032, 0.1}, 0.0}), kNotGraspable);  // 27.2 mm
  EXPECT_EQ(labelOf(RoundedBox{{0.044, 0.032, 0.1}, 0.006}), 1U);           // 24.87 mm
  EXPECT_EQ(labelOf(RoundedBox{{0.04, 0.028, 0.029}, 0.006}), kNotGraspable);
  EXPECT_EQ(labelOf(RoundedBox{{0.04, 0.028, 0.031}, 0.006}), 1U);
}

TEST(GripLabels, OvalIsHeldWhereItsLongAxisFits)
{
  EXPECT_NEAR(radiusOf(Oval{0.02, 0.012, 0.1}), 0.02, 1e-12) << "33 mm at the flat side: that does not matter";
  EXPECT_EQ(labelOf(Oval{0.027, 0.012, 0.1}), kNotGraspable);
  // The long semi-axis is 26 mm at 60 % of the height, which is the end of a cell.
  Scene tapered;
  tapered.add(Oval{0.02, 0.012, 0.1, 1.5}, Eigen::Isometry3d::Identity());
  const GripLabels labels = label(tapered);
  ASSERT_EQ(labels.grips().size(), 1U);
  EXPECT_NEAR(labels.grips().front().length, 0.06, 0.0041);
  EXPECT_LT(labels.grips().front().radius, 0.026);
}

TEST(GripLabels, ClearanceOfARoundedBoxIsMeasuredFromItsSurface)
{
  const auto grips = [](const Primitive& solid, double wall) {
    Scene scene;
    scene.add(solid, Eigen::Isometry3d::Identity());
    scene.add(HalfSpace{}, wallAt(wall));
    return label(scene).grips().size();
  };
  EXPECT_EQ(grips(RoundedBox{{0.04, 0.028, 0.1}, 0.006}, 0.0279), 0U);
  EXPECT_EQ(grips(RoundedBox{{0.04, 0.028, 0.1}, 0.006}, 0.0281), 1U);
  EXPECT_EQ(grips(RoundedBox{{0.028, 0.04, 0.1}, 0.006}, 0.0219), 0U);
  EXPECT_EQ(grips(RoundedBox{{0.028, 0.04, 0.1}, 0.006}, 0.0221), 1U);
  EXPECT_EQ(grips(Oval{0.02, 0.012, 0.1}, 0.0281), 1U);
  EXPECT_EQ(grips(Oval{0.02, 0.012, 0.1}, 0.0279), 0U);
}

TEST(GripLabels, WhatASingleViewOfTheSlimSideCannotKnowIsDoubtful)
{
  constexpr double kMargin = 0.001;
  const auto seenFrom = [&](const Primitive& solid, const std::vector<double>& degrees) {
    Scene scene;
    scene.add(solid, Eigen::Isometry3d::Identity());
    std::vector<Eigen::Vector3d> cameras;
    for (const double angle : degrees)
      cameras.emplace_back(std::cos(angle * kDegree), std::sin(angle * kDegree), 0.5);
    const GripLabels labels(
        scene, kDefinition, [](const Eigen::Vector3d&) { return kMargin; }, cameras);
    return labels.label(0, Eigen::Vector3d::Zero());
  };
  const Oval oval{0.02, 0.012, 0.1};  // long along x
  for (const double slim : {0.0, 44.0, -44.0, 136.0, 180.0})
    EXPECT_EQ(seenFrom(oval, {slim}), kDoubtful) << slim;
  for (const double broad : {46.0, 90.0, 134.0, -90.0})
    EXPECT_EQ(seenFrom(oval, {broad}), 1U) << broad;
  EXPECT_EQ(seenFrom(oval, {0.0, 90.0}), 1U) << "the second camera knows";
  EXPECT_EQ(seenFrom(oval, {0.0, 10.0}), kDoubtful);
  EXPECT_EQ(seenFrom(oval, {}), 1U);
  EXPECT_EQ(seenFrom(Oval{0.02, 0.0195, 0.1}, {0.0}), 1U) << "round within the margin";
  EXPECT_EQ(seenFrom(Oval{0.02, 0.0168, 0.1}, {0.0}), 1U) << "1.19 times as long as wide";
  EXPECT_EQ(seenFrom(Oval{0.02, 0.0165, 0.1}, {0.0}), kDoubtful) << "1.21 times";
  EXPECT_EQ(seenFrom(RoundedBox{{0.04, 0.028, 0.1}, 0.006}, {0.0}), kDoubtful);
  EXPECT_EQ(seenFrom(RoundedBox{{0.04, 0.028, 0.1}, 0.006}, {90.0}), 1U);
  EXPECT_EQ(seenFrom(Oval{0.03, 0.012, 0.1}, {0.0}), kNotGraspable) << "it does not fit, whatever the camera knows";
}

TEST(GripLabels, DoorHandleNeedsRoomForTheFinger)
{
  // A bar before a front; `to_spare` is the room behind it beyond what the finger needs.
  const auto barBeforeFront = [](double finger, double to_spare, double margin) {
    constexpr double radius = 0.006;
    Scene scene;
    scene.add(Cylinder{radius, 0.12}, Eigen::Isometry3d::Identity());
    scene.beginObject("front", Role::front);
    scene.add(Box{{0.02, 0.6, 0.6}}, at(radius + finger + to_spare + 0.01, 0.0, 0.0));
    GraspDefinition definition;
    definition.clearance = finger;
    return GripLabels(scene, definition, [margin](const Eigen::Vector3d&) { return margin; })
        .label(0, Eigen::Vector3d::Zero());
  };
  for (const double finger : {0.008, 0.012, 0.02}) {
    for (const double difference : {0.006, 0.008, 0.01}) {
      for (const double margin : {0.0, 0.0019, 0.0059}) {
        EXPECT_EQ(barBeforeFront(finger, difference, margin), 1U) << finger << " " << difference << " " << margin;
        EXPECT_EQ(barBeforeFront(finger, -difference, margin), kNotGraspable)
            << finger << " " << difference << " " << margin;
      }
    }
    EXPECT_EQ(barBeforeFront(finger, 0.006, 0.0065), kDoubtful) << "one disparity step of an Xtion at 1.5 m";
    EXPECT_EQ(barBeforeFront(finger, -0.006, 0.0065), kDoubtful);
  }
}

TEST(GripLabels, BarsOfTheBackgroundAreDoubtful)
{
  const auto labelOfBar = [](Role role) {
    Scene scene;
    scene.beginObject("bar", role);
    scene.add(Cylinder{0.01, 0.3}, Eigen::Isometry3d::Identity());
    scene.add(Box{{0.3, 0.3, 0.3}}, at(1.0, 0.0, 0.0));
    const GripLabels labels = label(scene);
    EXPECT_EQ(labels.label(1, Eigen::Vector3d::Zero()), kNotGraspable);
    return labels.label(0, Eigen::Vector3d::Zero());
  };
  EXPECT_EQ(labelOfBar(Role::thing), 1U);
  EXPECT_EQ(labelOfBar(Role::background), kDoubtful);
}

TEST(GripLabels, SpheresAndEllipsoidsAreHeldAboutAnyOfTheirAxes)
{
  EXPECT_EQ(labelOf(Sphere{0.025}), 1U);
  EXPECT_EQ(labelOf(Sphere{0.027}), kNotGraspable);
  EXPECT_EQ(labelOf(Sphere{0.025}, 0.0015), kDoubtful);
  EXPECT_EQ(labelOf(Ellipsoid{{0.02, 0.05, 0.019}}), 1U);
  EXPECT_EQ(labelOf(Ellipsoid{{0.024, 0.05, 0.02}}), kDoubtful);
  EXPECT_EQ(labelOf(Ellipsoid{{0.03, 0.05, 0.03}}), kNotGraspable);

  Scene table;
  table.add(Sphere{0.025}, at(0.0, 0.0, 0.025));
  table.add(HalfSpace{}, Eigen::Isometry3d::Identity());
  EXPECT_EQ(label(table).label(0, {0.0, 0.0, -0.025}), 1U);
  EXPECT_NEAR(label(table).grips().at(0).length, 0.05, 1e-12);

  Scene wall;
  wall.add(Sphere{0.025}, Eigen::Isometry3d::Identity());
  wall.add(HalfSpace{}, wallAt(0.03));
  EXPECT_EQ(label(wall).label(0, {0.025, 0.0, 0.0}), 1U) << "about the axis towards the wall";
  wall.add(HalfSpace{}, at(0.0, 0.0, -0.03));
  EXPECT_TRUE(label(wall).grips().empty()) << "in an edge between wall and floor";
}

TEST(GripLabels, ARingNeedsAHoleToReachThrough)
{
  EXPECT_EQ(labelOf(TorusArc{0.008, 0.005, kPi}), kNotGraspable);  // 6 mm
  EXPECT_EQ(labelOf(TorusArc{0.010, 0.005, kPi}), 1U);             // 10 mm
}

TEST(GripLabels, ARunMayPassTheSeamOfARing)
{
  Scene scene;
  scene.add(TorusArc{0.05, 0.008, kPi}, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(label(scene).grips().at(0).length, 2.0 * kPi * 0.05, 1e-12);
  scene.add(Sphere{0.01}, at(0.0, 0.05, 0.02));
  const GripLabels labels = label(scene);
  ASSERT_EQ(labels.grips().size(), 1U);
  EXPECT_EQ(labels.label(0, {0.0, 0.05, 0.008}), kNotGraspable);
  for (const double y : {-0.001, 0.001})
    EXPECT_EQ(labels.label(0, {-0.05, y, 0.008}), 1U);
  // Blocked where the ball of radius 1 cm is over the tube at all.
  EXPECT_NEAR(labels.grips()[0].length, 2.0 * kPi * 0.05 - 0.02, 0.008);
}

TEST(GripLabels, WhatStandsOnATableIsClearDownToIt)
{
  Scene scene;
  scene.add(Cylinder{0.02, 0.1}, at(0.0, 0.0, 0.05));
  scene.add(HalfSpace{}, Eigen::Isometry3d::Identity());
  const GripLabels labels = label(scene);
  ASSERT_EQ(labels.grips().size(), 1U);
  EXPECT_NEAR(labels.grips()[0].length, 0.1, 1e-12);
  EXPECT_EQ(labels.label(0, {0.02, 0.0, -0.05}), 1U);
  EXPECT_EQ(labels.label(1, {0.0, 0.0, 0.0}), kNotGraspable);
}

TEST(GripLabels, SurfaceInsideAnotherSolidHasNoClearance)
{
  Scene scene;
  scene.add(Cylinder{0.01, 0.1}, Eigen::Isometry3d::Identity());
  scene.add(Box{{0.2, 0.2, 0.06}}, at(0.0, 0.0, -0.05));  // up to z = -0.02
  const GripLabels labels = label(scene);
  ASSERT_EQ(labels.grips().size(), 1U);
  EXPECT_NEAR(labels.grips()[0].length, 0.07, 0.004);
  EXPECT_EQ(labels.label(0, {0.01, 0.0, -0.03}), kNotGraspable);
}

TEST(GripLabels, ProfilesAndRoundEndsAreJudgedByTheirWidestPlace)
{
  // A neck of 5 cm above a body; a bulge of 3 mm height, less than a cell, cuts it in two.
  using Profile = std::vector<Revolution::Station>;
  const Profile plain = {{0.0, 0.04}, {0.1, 0.04}, {0.11, 0.015}, {0.16, 0.015}};
  Profile bulge = plain;
  bulge.insert(bulge.end() - 1, {{0.1345, 0.015}, {0.136, 0.028}, {0.1375, 0.015}});
  const auto gripsOf = [](const Profile& profile) {
    Scene scene;
    scene.add(Revolution{profile}, at(0.0, 0.0, -0.3));
    return label(scene).grips();
  };
  ASSERT_EQ(gripsOf(plain).size(), 1U);
  EXPECT_NEAR(gripsOf(plain)[0].length, 0.05 + 0.004, 0.004);
  EXPECT_NEAR(gripsOf(plain)[0].axis.back().z(), 0.16 - 0.3, 1e-12);
  EXPECT_TRUE(gripsOf(bulge).empty());

  Scene capsule;
  capsule.add(Capsule{0.012, 0.02}, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(label(capsule).grips().at(0).length, 0.044, 1e-12);
}

TEST(GripLabels, RefusesMoreGripsThanLabels)
{
  Scene scene;
  for (int i = 0; i < 254; ++i)
    scene.add(Cylinder{0.01, 0.05}, at(0.1 * i, 0.0, 0.0));
  EXPECT_EQ(label(scene).grips().back().label, 254U);
  scene.add(Cylinder{0.01, 0.05}, at(-0.1, 0.0, 0.0));
  EXPECT_THROW(label(scene), std::length_error);
}

}  // namespace
}  // namespace grasp_affordances
