#include "nodelets/messages/markers.h"
#include "nodelets/messages/score_color.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr char kFrame[] = "optical";

std_msgs::Header makeHeader()
{
  std_msgs::Header header;
  header.frame_id = kFrame;
  return header;
}

/// What a viewer shows that has seen all arrays so far.
class Viewer
{
public:
  using Key = std::pair<std::string, int>;

  void receive(const MarkerArray& array)
  {
    for (const Marker& marker : array.markers) {
      EXPECT_EQ(marker.header.frame_id, marker.ns == "workspace" && marker.action == Marker::ADD ? "base" : kFrame);
      if (marker.action == Marker::DELETEALL) {
        shown_.clear();
      } else if (marker.action == Marker::DELETE) {
        shown_.erase({marker.ns, marker.id});
      } else {
        EXPECT_EQ(marker.lifetime, ros::Duration(0));
        EXPECT_GT(marker.color.a, 0.0F);
        shown_[{marker.ns, marker.id}] = marker;
      }
    }
  }

  std::set<Key> shown() const
  {
    std::set<Key> keys;
    for (const auto& [key, marker] : shown_) {
      keys.insert(key);
    }
    return keys;
  }

  const Marker& at(const std::string& ns, int id) const { return shown_.at({ns, id}); }

private:
  std::map<Key, Marker> shown_{{{"left by a predecessor", 5}, Marker()}};
};

/// Along x, 0.8 m in front of the sensor, with two hand poses.
GraspHandle makeHandle(std::uint32_t id)
{
  GraspHandle handle;
  handle.id = id;
  handle.centroid = {0.0, 0.0, 0.8};
  handle.axis = Eigen::Vector3d::UnitX();
  handle.normal = -Eigen::Vector3d::UnitZ();
  handle.radius = 0.01;
  handle.inner_radius = 0.012;
  handle.length = 0.1;
  handle.polyline = {{-0.05, 0.0, 0.8}, {0.0, 0.0, 0.8}, {0.05, 0.0, 0.8}};
  handle.score = 0.5;
  GraspPose grasp;
  grasp.pose.translation() = handle.centroid;
  grasp.width = 0.024;
  handle.hand_poses = {grasp, grasp};
  return handle;
}

MarkerArray update(LocalizationMarkers& markers, const Localization& localization)
{
  return markers.update(localization.shells, localization.handles, Config(), makeHeader(), "base");
}

TEST(LocalizationMarkers, AViewerShowsTheLatestResultAndNothingElse)
{
  LocalizationMarkers markers;
  Viewer viewer;
  const std::vector<std::pair<std::size_t, std::vector<std::uint32_t>>> results{{3, {1, 2}}, {1, {2}}, {4, {}},
                                                                                {0, {2, 7}}, {0, {}},  {2, {8}}};
  for (const auto& [shells, handles] : results) {
    Localization localization;
    localization.shells.resize(shells);
    std::set<Viewer::Key> expected;
    for (int i = 0; i < static_cast<int>(shells); ++i) {
      expected.insert({"shells", i});
      expected.insert({"axes", i});
    }
    for (const std::uint32_t id : handles) {
      localization.handles.push_back(makeHandle(id));
      for (const char* ns : {"handles", "handle_ids", "hand_poses"}) {
        expected.insert({ns, static_cast<int>(id)});
      }
    }
    viewer.receive(update(markers, localization));
    EXPECT_EQ(viewer.shown(), expected);
  }
}

TEST(LocalizationMarkers, AViewerThatMissedArraysShowsNothingStaleAfterTheNext)
{
  LocalizationMarkers markers;
  Viewer viewer;
  Localization localization;
  localization.shells.resize(10);
  localization.handles = {makeHandle(4)};
  viewer.receive(update(markers, localization));
  localization.shells.resize(3);
  localization.handles.clear();
  for (int lost = 0; lost < 50; ++lost) {
    update(markers, localization);
  }
  viewer.receive(update(markers, localization));
  EXPECT_EQ(viewer.shown().size(), 6U);
}

TEST(LocalizationMarkers, IdsThatHaveLongBeenGoneAreForgotten)
{
  LocalizationMarkers markers;
  std::size_t most = 0;
  for (std::uint32_t id = 1; id < 1000; ++id) {
    Localization localization;
    localization.handles = {makeHandle(id)};
    most = std::max(most, update(markers, localization).markers.size());
  }
  EXPECT_LT(most, 400U);
}

TEST(LocalizationMarkers, ACylinderHasTheShellsSize)
{
  Localization localization;
  localization.shells.resize(1);
  localization.shells[0].centroid = {0.1, 0.2, 0.8};
  localization.shells[0].inner_radius = 0.02;
  localization.shells[0].length = 0.05;
  LocalizationMarkers markers;
  Viewer viewer;
  viewer.receive(update(markers, localization));
  const Marker& cylinder = viewer.at("shells", 0);
  EXPECT_EQ(cylinder.type, Marker::CYLINDER);
  EXPECT_EQ(cylinder.scale.x, 0.04);
  EXPECT_EQ(cylinder.scale.y, 0.04);
  EXPECT_EQ(cylinder.scale.z, 0.05);
  EXPECT_EQ(cylinder.pose.position.z, 0.8);
}

TEST(LocalizationMarkers, ShellsOfAHandleAreFainterThanOthers)
{
  Localization localization;
  localization.shells.resize(2);
  localization.handles = {makeHandle(1)};
  localization.handles[0].shells = {1};
  LocalizationMarkers markers;
  Viewer viewer;
  viewer.receive(update(markers, localization));
  EXPECT_LT(viewer.at("shells", 1).color.a, viewer.at("shells", 0).color.a);
  EXPECT_LT(viewer.at("axes", 1).color.a, viewer.at("axes", 0).color.a);
}

TEST(LocalizationMarkers, AHandleIsAClosedTubeAroundItsAxis)
{
  Localization localization;
  localization.handles = {makeHandle(3)};
  LocalizationMarkers markers;
  Viewer viewer;
  viewer.receive(update(markers, localization));
  const Marker& tube = viewer.at("handles", 3);
  EXPECT_EQ(tube.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(tube.color, scoreColor(0.5));
  ASSERT_EQ(tube.points.size() % 3, 0U);
  const auto corner = [&](std::size_t i) {
    return Eigen::Vector3d(tube.points[i].x, tube.points[i].y, tube.points[i].z - 0.8);
  };
  // Signed volumes of the tetrahedra between the middle and each triangle: all positive where triangles face outwards.
  double volume = 0.0, area = 0.0;
  for (std::size_t i = 0; i < tube.points.size(); i += 3) {
    const Eigen::Vector3d normal = (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i));
    const double tetrahedron = corner(i).dot(normal) / 6.0;
    EXPECT_GT(tetrahedron, 0.0) << "triangle " << i / 3 << " faces inwards";
    volume += tetrahedron;
    area += normal.norm() / 2.0;
  }
  // A prism of 16 sides is a little smaller than the cylinder around it.
  constexpr double kRadius = 0.012;  // the handle's and 2 mm
  const double cylinder_volume = M_PI * kRadius * kRadius * 0.1, cylinder_area = 2 * M_PI * kRadius * (0.1 + kRadius);
  EXPECT_NEAR(volume / cylinder_volume, 0.975, 0.01);
  EXPECT_NEAR(area / cylinder_area, 0.99, 0.01);
}

TEST(LocalizationMarkers, AnIdIsWrittenBesideItsHandle)
{
  Localization localization;
  localization.handles = {makeHandle(12)};
  LocalizationMarkers markers;
  Viewer viewer;
  viewer.receive(update(markers, localization));
  const Marker& id = viewer.at("handle_ids", 12);
  EXPECT_EQ(id.type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(id.text, "12");
  EXPECT_EQ(id.pose.position.x, 0.0);
  EXPECT_LT(id.pose.position.z, 0.8 - 0.012 - id.scale.z / 2) << "towards the sensor, clear of the handle";
}

TEST(LocalizationMarkers, WithoutANormalHavePosesNevertheless)
{
  Localization localization;
  localization.handles = {makeHandle(12)};
  localization.handles[0].normal.setConstant(std::nan(""));
  localization.shells.resize(1);
  localization.shells[0].normal.setConstant(std::nan(""));
  LocalizationMarkers markers;
  const MarkerArray array = update(markers, localization);
  for (const Marker& marker : array.markers) {
    const geometry_msgs::Point& p = marker.pose.position;
    const geometry_msgs::Quaternion& q = marker.pose.orientation;
    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << marker.ns;
    if (marker.action == Marker::ADD) {
      EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9) << marker.ns;
    }
    if (marker.ns == "handle_ids") {
      EXPECT_GT(std::hypot(p.y, p.z - 0.8), 0.012 + marker.scale.z / 2) << "clear of the handle";
    }
  }
}

TEST(LocalizationMarkers, AHandIsDrawnWhereItIsAndNotItsTool)
{
  Config config;
  config.hand_poses.tool_x = 0.1;
  config.hand_poses.tool_yaw = M_PI / 2;
  GraspHandle handle = makeHandle(1);
  handle.hand_poses.resize(1);  // the hand is turned as the frame is: it approaches along x
  handle.hand_poses[0].pose = Eigen::Translation3d(0.0, 0.0, 0.8) * Eigen::Translation3d(0.1, 0.0, 0.0) *
                              Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  Localization localization;
  localization.handles = {handle};
  LocalizationMarkers markers;
  Viewer viewer;
  viewer.receive(markers.update(localization.shells, localization.handles, config, makeHeader(), "base"));
  const Marker& hands = viewer.at("hand_poses", 1);
  EXPECT_EQ(hands.type, Marker::LINE_LIST);
  ASSERT_EQ(hands.points.size(), hands.colors.size());
  double min_x = 1.0, max_x = -1.0, max_y = 0.0;
  for (const geometry_msgs::Point& p : hands.points) {
    min_x = std::min(min_x, p.x);
    max_x = std::max(max_x, p.x);
    max_y = std::max(max_y, std::abs(p.y));
    EXPECT_NEAR(p.z, 0.8, 1e-12);
  }
  EXPECT_NEAR(max_x, 0.012, 1e-12) << "finger tips";
  EXPECT_NEAR(min_x, -0.012 - config.hand.palm_depth, 1e-12) << "the far end of the palm";
  EXPECT_NEAR(max_y, 0.012 + config.hand.finger_thickness / 2, 1e-12) << "fingers beside the surface";
}

TEST(LocalizationMarkers, TheWorkspaceIsDrawnInItsFrameWhereItIsALimit)
{
  LocalizationMarkers markers;
  Viewer viewer;
  Config config;
  config.workspace.min_x = 0.2;
  config.workspace.max_x = 0.8;
  config.workspace.max_z = 1.5;
  viewer.receive(markers.update({}, {}, config, makeHeader(), "base"));
  const Marker& box = viewer.at("workspace", 0);
  EXPECT_EQ(box.header.frame_id, "base");
  EXPECT_EQ(box.points.size(), 24U) << "twelve edges";
  std::set<double> x, y, z;
  for (const geometry_msgs::Point& p : box.points) {
    x.insert(p.x);
    y.insert(p.y);
    z.insert(p.z);
  }
  EXPECT_EQ(x, (std::set<double>{0.2, 0.8}));
  EXPECT_EQ(y.size(), 2U);
  EXPECT_EQ(*z.rbegin(), 1.5);
  EXPECT_LE(*z.begin(), 0.0);
  viewer.receive(markers.update({}, {}, Config(), makeHeader(), "base"));
  EXPECT_TRUE(viewer.shown().empty()) << "deleted when there is no limit any more";
}

}  // namespace
}  // namespace grasp_affordances
