#include "nodelets/messages/handle_markers.h"

#include "core/result/axis_frame.h"
#include "nodelets/messages/conversions.h"
#include "nodelets/messages/score_color.h"

#include <visualization_msgs/InteractiveMarkerControl.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MenuEntry.h>

#include <cmath>
#include <cstddef>
#include <cstdio>

namespace grasp_affordances
{
namespace
{

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

constexpr double kLabelHeight = 0.03;    // m
constexpr double kLabelDistance = 0.03;  // m, from the surface of the cylinder
constexpr double kResolution = 0.001;    // m, of what is drawn
constexpr float kBodyOpacity = 0.5F;

double rounded(double value, double resolution = kResolution)
{
  return std::round(value / resolution) * resolution;
}

Eigen::Vector3d rounded(const Eigen::Vector3d& v)
{
  return v.unaryExpr([](double value) { return rounded(value); });
}

Eigen::Isometry3d rounded(const Eigen::Isometry3d& pose)
{
  constexpr double kTurn = 0.01;
  Eigen::Quaterniond turn(pose.linear());
  if (turn.w() < 0.0) {
    turn.coeffs() *= -1.0;
  }
  turn.coeffs() = turn.coeffs().unaryExpr([](double value) { return rounded(value, kTurn); });
  Eigen::Isometry3d result(turn.normalized());
  result.translation() = rounded(Eigen::Vector3d(pose.translation()));
  return result;
}

std_msgs::ColorRGBA color(double r, double g, double b)
{
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(r);
  color.g = static_cast<float>(g);
  color.b = static_cast<float>(b);
  color.a = 1.0F;
  return color;
}

Marker solid(std::int32_t type, const Eigen::Isometry3d& pose, const Eigen::Vector3d& size,
             const std_msgs::ColorRGBA& color)
{
  Marker marker;  // with no frame of its own: in that of the interactive marker
  marker.type = type;
  marker.pose = poseMessage(pose);
  marker.scale.x = size.x();
  marker.scale.y = size.y();
  marker.scale.z = size.z();
  marker.color = color;
  return marker;
}

Marker segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, std_msgs::ColorRGBA color)
{
  Eigen::Isometry3d pose(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from));
  pose.translation() = (from + to) / 2.0;
  color.a = kBodyOpacity;
  return solid(Marker::CYLINDER, pose, {2.0 * radius, 2.0 * radius, (to - from).norm()}, color);
}

Marker label(std::uint32_t id, double distance)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = distance;
  Marker marker = solid(Marker::TEXT_VIEW_FACING, pose, {0.0, 0.0, kLabelHeight}, color(1.0, 1.0, 1.0));
  marker.text = std::to_string(id);
  return marker;
}

InteractiveMarkerControl body(const GraspHandle& handle, const Eigen::Isometry3d& T_handle_header, bool selected,
                              double label_distance)
{
  InteractiveMarkerControl control;
  control.name = "body";
  control.interaction_mode = InteractiveMarkerControl::BUTTON;
  control.always_visible = true;
  const double radius = rounded(handle.inner_radius);
  const std_msgs::ColorRGBA color = selected ? selectedColor() : scoreColor(rounded(handle.score, 0.05));
  for (std::size_t i = 1; i < handle.polyline.size(); ++i) {
    const Eigen::Vector3d from = rounded(T_handle_header * handle.polyline[i - 1]);
    const Eigen::Vector3d to = rounded(T_handle_header * handle.polyline[i]);
    if (from != to) {
      control.markers.push_back(segment(from, to, radius, color));
    }
  }
  control.markers.push_back(label(handle.id, radius + label_distance));
  return control;
}

/// The palm's face touches the cylinder that the opening clears, and the fingers reach to its far side.
InteractiveMarkerControl gripper(const Eigen::Isometry3d& T_handle_hand, double opening, const HandGeometry& geometry)
{
  InteractiveMarkerControl control;
  control.name = "hand";
  control.interaction_mode = InteractiveMarkerControl::NONE;
  control.always_visible = true;
  const double width = rounded(opening);
  const auto box = [&](double x, double y, double length, double thickness) {
    const Eigen::Isometry3d pose = T_handle_hand * Eigen::Translation3d(x, y, 0.0);
    control.markers.push_back(
        solid(Marker::CUBE, pose, {length, thickness, geometry.palm_width}, color(0.8, 0.8, 0.85)));
  };
  const double thickness = geometry.finger_thickness;
  box(-(width + geometry.palm_depth) / 2.0, 0.0, geometry.palm_depth, width + 2.0 * thickness);
  box(0.0, (width + thickness) / 2.0, width, thickness);
  box(0.0, -(width + thickness) / 2.0, width, thickness);
  return control;
}

std::string facts(const GraspHandle& handle, const std::optional<GraspPose>& hand)
{
  const double width = hand ? hand->width : 2.0 * handle.inner_radius;
  char text[100];
  std::snprintf(text, sizeof(text), "Handle %u: score %.2f, width %.0f mm, length %.0f mm", handle.id, handle.score,
                1e3 * width, 1e3 * handle.length);
  return text;
}

void addMenuEntry(InteractiveMarker& marker, HandleMenu id, const std::string& title)
{
  visualization_msgs::MenuEntry entry;
  entry.id = static_cast<std::uint32_t>(id);
  entry.title = title;
  entry.command_type = visualization_msgs::MenuEntry::FEEDBACK;
  marker.menu_entries.push_back(entry);
}

}  // namespace

std_msgs::ColorRGBA selectedColor()
{
  return color(0.1, 0.4, 1.0);
}

std::string handleMarkerName(std::uint32_t id)
{
  return "handle_" + std::to_string(id);
}

InteractiveMarker handleMarker(const GraspHandle& handle, const std_msgs::Header& header, bool selected,
                               const std::optional<GraspPose>& hand, const HandGeometry& geometry)
{
  Eigen::Isometry3d T_header_handle = Eigen::Isometry3d::Identity();
  T_header_handle.linear() = rotationAlong(handle.axis, normalOrAny(handle.axis, handle.normal));
  T_header_handle.translation() = handle.centroid;
  const Eigen::Isometry3d T_handle_header = T_header_handle.inverse();

  InteractiveMarker marker;
  marker.header = header;
  marker.name = handleMarkerName(handle.id);
  marker.pose = poseMessage(T_header_handle);
  marker.scale = static_cast<float>(rounded(handle.length, 0.01));
  // Towards the sensor, and there in front of a hand.
  const double label_distance = kLabelDistance + (hand ? geometry.palm_depth : 0.0);
  marker.controls.push_back(body(handle, T_handle_header, selected, label_distance));
  if (hand) {
    marker.controls.push_back(gripper(rounded(T_handle_header * hand->pose), hand->width, geometry));
  }
  addMenuEntry(marker, HandleMenu::facts, facts(handle, hand));
  if (selected) {
    addMenuEntry(marker, HandleMenu::deselect, "Deselect");
    addMenuEntry(marker, HandleMenu::next_hand_pose, "Next hand pose");
    addMenuEntry(marker, HandleMenu::previous_hand_pose, "Previous hand pose");
  } else {
    addMenuEntry(marker, HandleMenu::select, "Select");
  }
  return marker;
}

}  // namespace grasp_affordances
