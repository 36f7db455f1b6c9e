#include "nodelets/markers.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

namespace grasp_affordances
{
namespace
{

using visualization_msgs::Marker;

/// What a viewer shows that has seen all arrays so far.
class Viewer
{
public:
  void receive(const visualization_msgs::MarkerArray& array)
  {
    for (const Marker& marker : array.markers) {
      EXPECT_EQ(marker.header.frame_id, "optical");
      if (marker.action == Marker::DELETEALL) {
        shown_.clear();
      } else if (marker.action == Marker::DELETE) {
        shown_.erase({marker.ns, marker.id});
      } else {
        EXPECT_EQ(marker.lifetime, ros::Duration(0));
        EXPECT_GT(marker.color.a, 0.0F);
        shown_.insert({marker.ns, marker.id});
      }
    }
  }

  const std::set<std::pair<std::string, int>>& shown() const { return shown_; }

private:
  std::set<std::pair<std::string, int>> shown_{{"left by a predecessor", 5}};
};

TEST(ShellMarkers, AViewerShowsTheLatestShellsAndNothingElse)
{
  std_msgs::Header header;
  header.frame_id = "optical";
  ShellMarkers markers;
  Viewer viewer;
  for (const std::size_t shells : {3, 1, 4, 0, 0, 2}) {
    Localization localization;
    localization.shells.resize(shells);
    viewer.receive(markers.update(localization, header));

    std::set<std::pair<std::string, int>> expected;
    for (int i = 0; i < static_cast<int>(shells); ++i) {
      expected.insert({"shells", i});
      expected.insert({"axes", i});
    }
    EXPECT_EQ(viewer.shown(), expected);
  }
}

TEST(ShellMarkers, AViewerThatMissedAnArrayShowsNothingStaleAfterTheNext)
{
  std_msgs::Header header;
  header.frame_id = "optical";
  ShellMarkers markers;
  Viewer viewer;
  Localization localization;
  localization.shells.resize(10);
  viewer.receive(markers.update(localization, header));
  localization.shells.resize(3);
  markers.update(localization, header);  // lost
  viewer.receive(markers.update(localization, header));
  EXPECT_EQ(viewer.shown().size(), 6U);
}

TEST(ShellMarkers, ACylinderHasTheShellsSize)
{
  Localization localization;
  localization.shells.resize(1);
  localization.shells[0].centroid = {0.1, 0.2, 0.8};
  localization.shells[0].inner_radius = 0.02;
  localization.shells[0].length = 0.05;
  const visualization_msgs::MarkerArray array = ShellMarkers().update(localization, std_msgs::Header());
  ASSERT_EQ(array.markers.size(), 3U);
  const Marker& cylinder = array.markers[1];
  EXPECT_EQ(cylinder.ns, "shells");
  EXPECT_EQ(cylinder.type, Marker::CYLINDER);
  EXPECT_EQ(cylinder.scale.x, 0.04);
  EXPECT_EQ(cylinder.scale.y, 0.04);
  EXPECT_EQ(cylinder.scale.z, 0.05);
  EXPECT_EQ(cylinder.pose.position.z, 0.8);
}

}  // namespace
}  // namespace grasp_affordances
