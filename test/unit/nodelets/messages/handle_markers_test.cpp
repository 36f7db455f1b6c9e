#include "nodelets/messages/handle_markers.h"
#include "nodelets/messages/score_color.h"

#include <gtest/gtest.h>
#include <visualization_msgs/InteractiveMarkerControl.h>
#include <visualization_msgs/Marker.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

/// A bent handle: 6 cm along y, then 8 cm along z.
GraspHandle bentHandle()
{
  GraspHandle handle;
  handle.id = 7;
  handle.centroid = {0.1, 0.2, 0.8};
  handle.axis = Eigen::Vector3d::UnitY();
  handle.normal = -Eigen::Vector3d::UnitZ();
  handle.inner_radius = 0.02;
  handle.length = 0.14;
  handle.score = 1.0;
  handle.polyline = {{0.1, 0.14, 0.8}, {0.1, 0.2, 0.8}, {0.1, 0.2, 0.88}};
  return handle;
}

InteractiveMarker drawn(const GraspHandle& handle, bool selected, const std::optional<GraspPose>& hand = std::nullopt)
{
  std_msgs::Header header;
  header.frame_id = "optical";
  header.stamp = ros::Time(12, 34);
  return handleMarker(handle, header, selected, hand, HandGeometry());
}

Eigen::Isometry3d pose(const geometry_msgs::Pose& message)
{
  Eigen::Isometry3d pose(
      Eigen::Quaterniond(message.orientation.w, message.orientation.x, message.orientation.y, message.orientation.z));
  pose.translation() << message.position.x, message.position.y, message.position.z;
  return pose;
}

std::vector<Marker> ofType(const InteractiveMarker& marker, std::int32_t type)
{
  std::vector<Marker> found;
  for (const InteractiveMarkerControl& control : marker.controls) {
    for (const Marker& part : control.markers) {
      EXPECT_TRUE(part.header.frame_id.empty()) << "parts are in the frame of the whole";
      if (part.type == type) {
        found.push_back(part);
      }
    }
  }
  return found;
}

std::vector<std::string> menu(const InteractiveMarker& marker)
{
  std::vector<std::string> titles;
  for (const visualization_msgs::MenuEntry& entry : marker.menu_entries) {
    titles.push_back(entry.title);
  }
  return titles;
}

TEST(ScoreColor, GoesFromRedOverYellowToGreen)
{
  for (int i = 0; i <= 10; ++i) {
    const double score = i / 10.0;
    const std_msgs::ColorRGBA color = scoreColor(score);
    EXPECT_EQ(color.a, 1.0F);
    EXPECT_EQ(color.b, 0.0F);
    EXPECT_EQ(std::max(color.r, color.g), 1.0F) << "dull at " << score;
    EXPECT_NEAR(color.g - color.r, 2.0 * score - 1.0, 1e-6) << "at " << score;
  }
  EXPECT_EQ(scoreColor(0.5).r, scoreColor(0.5).g);
  EXPECT_EQ(scoreColor(-1.0), scoreColor(0.0));
  EXPECT_EQ(scoreColor(2.0), scoreColor(1.0));
  EXPECT_EQ(scoreColor(std::numeric_limits<double>::quiet_NaN()), scoreColor(0.0));
  EXPECT_GT(selectedColor().b, 0.5F);
}

TEST(HandleMarker, ACylinderCoversEachPieceOfTheAxis)
{
  const GraspHandle handle = bentHandle();
  const InteractiveMarker marker = drawn(handle, false);
  EXPECT_EQ(marker.header.frame_id, "optical");
  EXPECT_EQ(marker.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(marker.name, handleMarkerName(7));

  const std::vector<Marker> cylinders = ofType(marker, Marker::CYLINDER);
  ASSERT_EQ(cylinders.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(cylinders[i].scale.x, 0.04, 1e-9);
    EXPECT_NEAR(cylinders[i].scale.y, 0.04, 1e-9);
    const Eigen::Isometry3d T_header_cylinder = pose(marker.pose) * pose(cylinders[i].pose);
    const Eigen::Vector3d half = cylinders[i].scale.z / 2.0 * Eigen::Vector3d::UnitZ();
    EXPECT_LT((T_header_cylinder * -half - handle.polyline[i]).norm(), 1e-9);
    EXPECT_LT((T_header_cylinder * half - handle.polyline[i + 1]).norm(), 1e-9);
  }
  const std::vector<Marker> labels = ofType(marker, Marker::TEXT_VIEW_FACING);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].text, "7");
}

TEST(HandleMarker, IsClickable)
{
  const InteractiveMarker marker = drawn(bentHandle(), false);
  ASSERT_EQ(marker.controls.size(), 1U);
  EXPECT_EQ(marker.controls[0].interaction_mode, InteractiveMarkerControl::BUTTON);
  EXPECT_TRUE(marker.controls[0].always_visible);
}

TEST(HandleMarker, TheSelectedOneHasAnotherColourAndAnotherMenu)
{
  const InteractiveMarker plain = drawn(bentHandle(), false), selected = drawn(bentHandle(), true);
  EXPECT_EQ(ofType(plain, Marker::CYLINDER)[0].color.g, 1.0F);
  EXPECT_EQ(ofType(selected, Marker::CYLINDER)[0].color.b, selectedColor().b);
  const std::string facts = "Handle 7: score 1.00, width 40 mm, length 140 mm";
  EXPECT_EQ(menu(plain), (std::vector<std::string>{facts, "Select"}));
  EXPECT_EQ(menu(selected), (std::vector<std::string>{facts, "Deselect", "Next hand pose", "Previous hand pose"}));
}

TEST(HandleMarker, AHandClosesAroundTheHandle)
{
  const HandGeometry geometry;
  GraspPose hand;  // from the camera, along its z
  hand.pose.linear() << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  hand.pose.translation() << 0.1, 0.2, 0.8;
  hand.width = 0.05;
  const InteractiveMarker marker = drawn(bentHandle(), true, hand);
  const std::vector<Marker> boxes = ofType(marker, Marker::CUBE);
  ASSERT_EQ(boxes.size(), 3U);

  // In the frame of the hand: the palm ends where the opening begins, and the fingers leave its width between them.
  const auto inHand = [&](const Marker& box) { return hand.pose.inverse() * pose(marker.pose) * pose(box.pose); };
  const Eigen::Isometry3d palm = inHand(boxes[0]);
  EXPECT_LT((palm.linear() - Eigen::Matrix3d::Identity()).norm(), 0.02);
  EXPECT_NEAR(palm.translation().x() + boxes[0].scale.x / 2.0, -0.025, 1e-3);
  EXPECT_NEAR(boxes[0].scale.x, geometry.palm_depth, 1e-9);
  for (std::size_t i = 1; i < 3; ++i) {
    const Eigen::Vector3d finger = inHand(boxes[i]).translation();
    EXPECT_NEAR(std::abs(finger.y()) - boxes[i].scale.y / 2.0, 0.025, 1e-3);
    EXPECT_NEAR(boxes[i].scale.y, geometry.finger_thickness, 1e-9);
    EXPECT_NEAR(boxes[i].scale.z, geometry.palm_width, 1e-9);
  }
}

TEST(HandleMarker, WithoutANormalHasAPoseNevertheless)
{
  GraspHandle handle = bentHandle();
  handle.normal.setConstant(std::nan(""));
  GraspPose hand;
  hand.pose.translation() = handle.centroid;
  const InteractiveMarker marker = drawn(handle, true, hand);
  EXPECT_NEAR(pose(marker.pose).linear().determinant(), 1.0, 1e-9);
  EXPECT_LT((pose(marker.pose).linear().col(2) - handle.axis).norm(), 1e-9);
  for (const std::int32_t type : std::vector<std::int32_t>{Marker::CYLINDER, Marker::CUBE, Marker::TEXT_VIEW_FACING}) {
    const std::vector<Marker> parts = ofType(marker, type);
    EXPECT_FALSE(parts.empty());
    for (const Marker& part : parts) {
      EXPECT_TRUE(pose(part.pose).matrix().allFinite());
      EXPECT_NEAR(pose(part.pose).linear().determinant(), 1.0, 1e-9);
    }
  }
}

TEST(HandleMarker, NoiseAndMotionOfTheWholeChangeThePoseOnly)
{
  GraspHandle moved =
      transformed(bentHandle(), Eigen::Translation3d(0.0101, -0.0234, 0.0302) *
                                    Eigen::Isometry3d(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())));
  moved.length += 0.0001;
  moved.inner_radius += 0.0001;
  InteractiveMarker before = drawn(bentHandle(), false), after = drawn(moved, false);
  EXPECT_NE(before.pose, after.pose);
  before.pose = after.pose;
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace grasp_affordances
