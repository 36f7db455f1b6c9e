#include "nodelets/markers.h"

#include "nodelets/conversions.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

using visualization_msgs::Marker;

constexpr char kShells[] = "shells";
constexpr char kAxes[] = "axes";
constexpr double kAxisDiameter = 0.003;  // m
constexpr double kAxisOverhang = 0.02;   // m beyond either end of the shell

Marker marker(const std_msgs::Header& header, const char* ns, std::size_t index, std::int32_t action)
{
  Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.id = static_cast<std::int32_t>(index);
  marker.action = action;
  marker.pose.orientation.w = 1.0;
  return marker;
}

Marker cylinder(const std_msgs::Header& header, const char* ns, std::size_t index, const Shell& shell, double diameter,
                double length)
{
  Marker cylinder = marker(header, ns, index, Marker::ADD);
  cylinder.type = Marker::CYLINDER;
  cylinder.pose = poseMessage(shell);
  cylinder.scale.x = diameter;
  cylinder.scale.y = diameter;
  cylinder.scale.z = length;
  return cylinder;
}

Marker shellMarker(const std_msgs::Header& header, std::size_t index, const Shell& shell)
{
  Marker marker = cylinder(header, kShells, index, shell, 2.0 * shell.inner_radius, shell.length);
  marker.color.r = 0.1F;
  marker.color.g = 0.8F;
  marker.color.b = 0.2F;
  marker.color.a = 0.12F;
  return marker;
}

Marker axisMarker(const std_msgs::Header& header, std::size_t index, const Shell& shell)
{
  Marker marker = cylinder(header, kAxes, index, shell, kAxisDiameter, shell.length + 2.0 * kAxisOverhang);
  marker.color.r = 0.9F;
  marker.color.g = 0.1F;
  marker.color.b = 0.1F;
  marker.color.a = 1.0F;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray ShellMarkers::update(const Localization& localization, const std_msgs::Header& header)
{
  visualization_msgs::MarkerArray array;
  if (first_) {
    array.markers.push_back(marker(header, "", 0, Marker::DELETEALL));
    first_ = false;
  }
  for (std::size_t i = 0; i < localization.shells.size(); ++i) {
    array.markers.push_back(shellMarker(header, i, localization.shells[i]));
    array.markers.push_back(axisMarker(header, i, localization.shells[i]));
  }
  for (std::size_t i = localization.shells.size(); i < drawn_; ++i) {
    array.markers.push_back(marker(header, kShells, i, Marker::DELETE));
    array.markers.push_back(marker(header, kAxes, i, Marker::DELETE));
  }
  drawn_ = std::max(drawn_, localization.shells.size());
  return array;
}

}  // namespace grasp_affordances
