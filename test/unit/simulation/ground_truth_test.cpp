#include "simulation/ground_truth.h"
#include "support/grips.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

TEST(GripLabels, RadiusFollowsTheSurfaceAlongTheAxis)
{
  const Eigen::Isometry3d pose = lying(0.1, 0.2, 0.3);
  const auto cone = gripsOfSolid(Frustum{0.02, 0.008, 0.12}, pose);
  ASSERT_EQ(cone.size(), 1U);
  ASSERT_EQ(cone[0].radii.size(), cone[0].axis.size());
  for (std::size_t i = 0; i < cone[0].axis.size(); ++i) {
    const double z = (pose.inverse() * cone[0].axis[i]).z();
    EXPECT_NEAR(cone[0].radii[i], 0.014 - 0.1 * z, 1e-12) << "at " << z;
  }
  EXPECT_FALSE(cone[0].ball_center);

  const auto bow = gripsOfSolid(TorusArc{0.04, 0.009, 0.5 * kPi}, pose);
  ASSERT_EQ(bow.size(), 1U);
  ASSERT_EQ(bow[0].radii.size(), bow[0].axis.size());
  for (const double radius : bow[0].radii)
    EXPECT_DOUBLE_EQ(radius, 0.009);

  const auto flat = gripsOfSolid(EllipticCylinder{0.015, 0.012, 0.1}, pose);
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_DOUBLE_EQ(flat[0].radii.front(), 0.015) << "half the larger size of the section";
}

TEST(GripLabels, RadiiOfAChainAreThoseOfItsPartsInOrder)
{
  Scene scene;
  const std::size_t upper = scene.add(Cylinder{0.008, 0.1}, at(0.0, 0.0, 0.15));
  const std::size_t lower = scene.add(Cylinder{0.012, 0.1}, at(0.0, 0.0, 0.05));
  scene.join({upper, lower});
  const std::vector<Grip> grips = label(scene).grips();
  ASSERT_EQ(grips.size(), 1U);
  ASSERT_EQ(grips[0].radii.size(), grips[0].axis.size());
  for (std::size_t i = 0; i < grips[0].axis.size(); ++i) {
    const double z = grips[0].axis[i].z();
    if (std::abs(z - 0.1) > 1e-9) {
      EXPECT_DOUBLE_EQ(grips[0].radii[i], z > 0.1 ? 0.008 : 0.012) << "at " << z;
    }
  }
}

TEST(GripLabels, BallHasACentreAndNoDirection)
{
  const Eigen::Vector3d place(0.1, 0.2, 0.3);
  const auto ball = gripsOfSolid(Sphere{0.02}, at(0.1, 0.2, 0.3));
  ASSERT_EQ(ball.size(), 1U);
  ASSERT_TRUE(ball[0].ball_center);
  EXPECT_TRUE(ball[0].ball_center->isApprox(place));
  const auto egg = gripsOfSolid(Ellipsoid{{0.018, 0.018, 0.024}}, lying(0.1, 0.2, 0.3));
  ASSERT_EQ(egg.size(), 1U);
  ASSERT_TRUE(egg[0].ball_center);
  EXPECT_TRUE(egg[0].ball_center->isApprox(place));
  EXPECT_FALSE(gripsOfSolid(Ellipsoid{{0.015, 0.015, 0.04}}, lying(0.1, 0.2, 0.3)).at(0).ball_center) << "slender";
  EXPECT_FALSE(gripsOfSolid(Cylinder{0.02, 0.04}, lying(0.1, 0.2, 0.3)).at(0).ball_center) << "flat ends";
}

/// A bar of 20 cm, 0.8 m before the camera and parallel to the image, with a plate right behind it.
View barBeforePlate(double clearance)
{
  View view;
  view.scene.beginObject("rail");
  view.scene.add(Cylinder{0.01, 0.2}, lying(0.0, 0.0, 0.8));
  view.scene.beginObject("plate");
  view.scene.add(Box{{0.4, 0.4, 0.02}}, at(0.0, 0.0, 0.82 + clearance));
  return view;
}

TEST(GroundTruth, DescribesABarThatIsHalfHidden)
{
  View view = barBeforePlate(0.02);
  const SensorModel model;
  const auto capture = [&] { return DepthCamera(model).capture(view.scene, view.T_scene_camera, 1); };
  const Frame open_frame = capture();
  const GroundTruth open = groundTruth(view, open_frame, model);
  ASSERT_EQ(open.affordances.size(), 1U);
  EXPECT_EQ(open.affordances[0].occluded_share, 0.0);

  view.scene.beginObject("screen");
  view.scene.add(Box{{0.4, 0.4, 0.01}}, at(-0.2, 0.0, 0.7));
  const Frame frame = capture();
  const GroundTruth truth = groundTruth(view, frame, model);
  ASSERT_EQ(truth.affordances.size(), 1U);
  const Affordance& bar = truth.affordances.front();
  EXPECT_EQ(bar.object, "rail");
  EXPECT_EQ(bar.label, 1U);
  EXPECT_NEAR(bar.radius, 0.01, 1e-12);
  ASSERT_EQ(bar.radii.size(), bar.axis.size());
  EXPECT_NEAR(bar.radii.front(), 0.01, 1e-12);
  EXPECT_FALSE(bar.ball_center);
  EXPECT_NEAR(bar.length, 0.2, 1e-12);
  EXPECT_NEAR(bar.distance, 0.8, 1e-12);
  EXPECT_NEAR(bar.occluded_share, 0.5, 0.01);
  EXPECT_EQ(bar.visible_points,
            static_cast<std::size_t>(std::count(truth.labels.begin(), truth.labels.end(), bar.label)));
  EXPECT_GT(bar.visible_points, 500U);
  EXPECT_NEAR(static_cast<double>(bar.visible_points), 0.5 * open.affordances[0].visible_points,
              0.1 * open.affordances[0].visible_points);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    const bool bar_measured = frame.cloud.measured(i) && frame.parts[i] == 0;
    ASSERT_EQ(truth.labels[i], bar_measured ? 1U : kNotGraspable);
  }
}

TEST(GroundTruth, MarginGrowsWithTheDepthQuantum)
{
  const auto labelAt = [](double clearance, const SensorModel& model) {
    const View view = barBeforePlate(clearance);
    const Frame frame = DepthCamera(model).capture(view.scene, view.T_scene_camera, 1);
    const std::vector<std::uint32_t> labels = groundTruth(view, frame, model).labels;
    return *std::max_element(labels.begin(), labels.end());
  };
  SensorModel model;
  const double quantum = model.depthQuantum(0.8);
  ASSERT_GT(quantum, 0.0015);
  EXPECT_EQ(labelAt(0.008 - 1.05 * quantum, model), kNotGraspable);
  EXPECT_EQ(labelAt(0.008 - 0.95 * quantum, model), kDoubtful);
  EXPECT_EQ(labelAt(0.008 + 0.95 * quantum, model), kDoubtful);
  EXPECT_EQ(labelAt(0.008 + 1.05 * quantum, model), 1U);
  model.disparity_step = 0.01;
  EXPECT_EQ(labelAt(0.008 + 0.00095, model), kDoubtful) << "at least 1 mm";
  EXPECT_EQ(labelAt(0.008 + 0.00105, model), 1U);
}

TEST(GroundTruth, MarginIsThatOfTheFarthestCamera)
{
  const SensorModel model;
  const View view = barBeforePlate(0.008 + 1.05 * model.depthQuantum(0.8));
  const Frame frame = DepthCamera(model).capture(view.scene, view.T_scene_camera, 1);
  const auto largestLabel = [&](const std::vector<Eigen::Isometry3d>& other_cameras) {
    const GroundTruth truth = groundTruth(view, frame, model, kDefinition, other_cameras);
    return *std::max_element(truth.labels.begin(), truth.labels.end());
  };
  EXPECT_EQ(largestLabel({view.T_scene_camera, at(0.0, 0.0, 0.3)}), 1U);
  EXPECT_EQ(largestLabel({view.T_scene_camera, at(0.0, 0.0, -0.3)}), kDoubtful);
}

TEST(GroundTruth, IsEmptyForAnEmptyScene)
{
  const SensorModel model;
  const GroundTruth truth =
      groundTruth(View{}, DepthCamera(model).capture(Scene(), Eigen::Isometry3d::Identity(), 1), model);
  EXPECT_TRUE(truth.affordances.empty());
  EXPECT_EQ(truth.labels, std::vector<std::uint32_t>(640 * 480, kNotGraspable));
}

}  // namespace
}  // namespace grasp_affordances
