#include "nodelets/messages/markers.h"

#include "core/result/axis_frame.h"
#include "core/result/polyline.h"
#include "nodelets/messages/conversions.h"
#include "nodelets/messages/score_color.h"

#include <std_msgs/ColorRGBA.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <vector>

namespace grasp_affordances
{
namespace
{

using visualization_msgs::Marker;

constexpr double kAxisDiameter = 0.003;   // m
constexpr double kAxisOverhang = 0.02;    // m beyond either end of the shell
constexpr double kLabelHeight = 0.03;     // m
constexpr double kLabelDistance = 0.03;   // m, from the shell
constexpr double kHandLineWidth = 0.003;  // m
constexpr double kBoxLineWidth = 0.004;   // m
constexpr double kOpenSide = 3.0;         // m, at which a side of the workspace without a limit is drawn
constexpr int kTubeSides = 16;
constexpr std::size_t kMostHandPoses = 8;  // of a handle that are drawn
constexpr int kDeletions = 100;            // arrays that delete a marker

std_msgs::ColorRGBA color(double r, double g, double b, double a)
{
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(r);
  color.g = static_cast<float>(g);
  color.b = static_cast<float>(b);
  color.a = static_cast<float>(a);
  return color;
}

geometry_msgs::Point point(const Eigen::Vector3d& p)
{
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

Marker marker(const std_msgs::Header& header, const std::string& ns, std::int32_t id, std::int32_t type)
{
  Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

Marker removal(const std_msgs::Header& header, const std::string& ns, std::int32_t id, std::int32_t action)
{
  Marker removal = marker(header, ns, id, Marker::ARROW);
  removal.action = action;
  return removal;
}

Marker cylinder(const std_msgs::Header& header, const char* ns, std::size_t index, const Shell& shell, double diameter,
                double length)
{
  Marker cylinder = marker(header, ns, static_cast<std::int32_t>(index), Marker::CYLINDER);
  cylinder.pose = poseMessage(shell);
  cylinder.scale.x = diameter;
  cylinder.scale.y = diameter;
  cylinder.scale.z = length;
  return cylinder;
}

/// The more shells there are in one place, the fainter is each, and a dark color does not shine through the others': a
/// viewer that rounds each one's share up would show hundreds as one bright body.
/// @param neighbors  shells of the same handle; 0: of none
Marker shellMarker(const std_msgs::Header& header, std::size_t index, const Shell& shell, std::size_t neighbors)
{
  Marker marker = cylinder(header, "shells", index, shell, 2.0 * shell.inner_radius, shell.length);
  marker.color = neighbors > 0 ? color(0.15, 0.2, 0.3, std::clamp(0.2 / static_cast<double>(neighbors), 0.002, 0.05))
                               : color(0.5, 0.7, 0.9, 0.12);
  return marker;
}

Marker axisMarker(const std_msgs::Header& header, std::size_t index, const Shell& shell, bool is_of_handle)
{
  const double overhang = is_of_handle ? 0.0 : kAxisOverhang;
  Marker marker = cylinder(header, "axes", index, shell, is_of_handle ? 0.3 * kAxisDiameter : kAxisDiameter,
                           shell.length + 2.0 * overhang);
  marker.color = color(0.9, 0.1, 0.1, is_of_handle ? 0.3 : 1.0);
  return marker;
}

/// Unit vectors along a line at each of its points, in the middle between the directions to its neighbors.
std::vector<Eigen::Vector3d> tangents(const std::vector<Eigen::Vector3d>& line)
{
  std::vector<Eigen::Vector3d> tangents;
  for (std::size_t i = 0; i < line.size(); ++i) {
    tangents.push_back(chordAround(line, i).stableNormalized());
  }
  return tangents;
}

/// A ring of points about each of a line's, the next one twisted as little as can be against the one before.
std::vector<std::array<Eigen::Vector3d, kTubeSides>> rings(const std::vector<Eigen::Vector3d>& line, double radius)
{
  const std::vector<Eigen::Vector3d> along = tangents(line);
  std::vector<std::array<Eigen::Vector3d, kTubeSides>> rings(line.size());
  Eigen::Vector3d normal = along.front().unitOrthogonal();
  for (std::size_t i = 0; i < line.size(); ++i) {
    normal = normalAcross(along[i], normal, 1e-6);
    const Eigen::Vector3d third = along[i].cross(normal);
    for (int k = 0; k < kTubeSides; ++k) {
      const double angle = 2.0 * M_PI * k / kTubeSides;
      rings[i][static_cast<std::size_t>(k)] = line[i] + radius * (std::cos(angle) * normal + std::sin(angle) * third);
    }
  }
  return rings;
}

/// Triangles counter-clockwise as seen from outside, which is how rviz lights them; closed at the ends.
void addTube(Marker& marker, const std::vector<Eigen::Vector3d>& line, double radius)
{
  const auto triangle = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    for (const Eigen::Vector3d& corner : {a, b, c}) {
      marker.points.push_back(point(corner));
    }
  };
  const auto tube = rings(line, radius);
  for (std::size_t k = 0; k < kTubeSides; ++k) {
    const std::size_t next = (k + 1) % kTubeSides;
    triangle(line.front(), tube.front()[next], tube.front()[k]);
    triangle(line.back(), tube.back()[k], tube.back()[next]);
    for (std::size_t i = 0; i + 1 < tube.size(); ++i) {
      triangle(tube[i][k], tube[i][next], tube[i + 1][next]);
      triangle(tube[i][k], tube[i + 1][next], tube[i + 1][k]);
    }
  }
}

Marker handleMarker(const std_msgs::Header& header, const GraspHandle& handle)
{
  Marker marker =
      grasp_affordances::marker(header, "handles", static_cast<std::int32_t>(handle.id), Marker::TRIANGLE_LIST);
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = scoreColor(handle.score);
  constexpr double kCover = 0.002;  // m, so that points of the noisy surface do not show through
  addTube(marker, handle.polyline, handle.radius + kCover);
  return marker;
}

Marker idMarker(const std_msgs::Header& header, const GraspHandle& handle)
{
  Marker marker =
      grasp_affordances::marker(header, "handle_ids", static_cast<std::int32_t>(handle.id), Marker::TEXT_VIEW_FACING);
  const Eigen::Vector3d side = normalOrAny(handle.axis, handle.normal);
  marker.pose.position = point(handle.centroid + (handle.inner_radius + kLabelDistance) * side);
  marker.scale.z = kLabelHeight;
  marker.color = color(1.0, 1.0, 1.0, 1.0);
  marker.text = std::to_string(handle.id);
  return marker;
}

/// Finger, palm, thumb and wrist. Where the hand is and how it is built: see HandGeometry and GraspPose.
void addHand(Marker& marker, const GraspPose& grasp, const Config& config, const std_msgs::ColorRGBA& color)
{
  const Eigen::Isometry3d hand = poseOfHand(grasp, config.hand_poses);
  const double reach = 0.5 * grasp.width, side = reach + 0.5 * config.hand.finger_thickness;
  const auto line = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    for (const Eigen::Vector3d& end : {from, to}) {
      marker.points.push_back(point(hand * end));
      marker.colors.push_back(color);
    }
  };
  line({reach, side, 0.0}, {-reach, side, 0.0});
  line({-reach, side, 0.0}, {-reach, -side, 0.0});
  line({-reach, -side, 0.0}, {reach, -side, 0.0});
  line({-reach, 0.0, 0.0}, {-reach - config.hand.palm_depth, 0.0, 0.0});
}

Marker handsMarker(const std_msgs::Header& header, const GraspHandle& handle, const Config& config)
{
  Marker marker =
      grasp_affordances::marker(header, "hand_poses", static_cast<std::int32_t>(handle.id), Marker::LINE_LIST);
  marker.scale.x = kHandLineWidth;
  marker.color = color(1.0, 1.0, 1.0, 1.0);
  for (std::size_t i = std::min(handle.hand_poses.size(), kMostHandPoses); i-- > 0;) {
    addHand(marker, handle.hand_poses[i], config, i == 0 ? color(0.5, 0.8, 1.0, 1.0) : color(0.2, 0.3, 0.5, 1.0));
  }
  return marker;
}

/// The lower and upper end of a side that is drawn: where there is no limit, somewhere beyond what is seen.
std::array<double, 2> drawnSide(double min, double max)
{
  const double lower = WorkspaceConfig::isLowerLimit(min) ? min : std::min(-kOpenSide, max - kOpenSide);
  const double upper = WorkspaceConfig::isUpperLimit(max) ? max : std::max(kOpenSide, min + kOpenSide);
  return {lower, upper};
}

Marker workspaceMarker(const std_msgs::Header& header, const WorkspaceConfig& box)
{
  Marker marker = grasp_affordances::marker(header, "workspace", 0, Marker::LINE_LIST);
  marker.scale.x = kBoxLineWidth;
  marker.color = color(0.9, 0.6, 0.9, 1.0);
  const auto x = drawnSide(box.min_x, box.max_x), y = drawnSide(box.min_y, box.max_y),
             z = drawnSide(box.min_z, box.max_z);
  const auto corner = [&](unsigned i) { return point({x[i & 1U], y[i >> 1U & 1U], z[i >> 2U & 1U]}); };
  for (unsigned i = 0; i < 8; ++i) {
    for (const unsigned side : {1U, 2U, 4U}) {
      if ((i & side) == 0) {
        marker.points.push_back(corner(i));
        marker.points.push_back(corner(i | side));
      }
    }
  }
  return marker;
}

/// Of each shell how many its handle has, itself included; 0 where it is of none.
std::vector<std::size_t> shellsOfItsHandle(std::size_t shells, const std::vector<GraspHandle>& handles)
{
  std::vector<std::size_t> counts(shells, 0);
  for (const GraspHandle& handle : handles) {
    for (const std::uint32_t i : handle.shells) {
      counts[i] = handle.shells.size();
    }
  }
  return counts;
}

}  // namespace

visualization_msgs::MarkerArray LocalizationMarkers::update(const std::vector<Shell>& shells,
                                                            const std::vector<GraspHandle>& handles,
                                                            const Config& config, const std_msgs::Header& header,
                                                            const std::string& workspace_frame)
{
  visualization_msgs::MarkerArray array;
  if (first_) {
    array.markers.push_back(removal(header, "", 0, Marker::DELETEALL));
    first_ = false;
  }
  const std::vector<std::size_t> neighbors = shellsOfItsHandle(shells.size(), handles);
  for (std::size_t i = 0; i < shells.size(); ++i) {
    array.markers.push_back(shellMarker(header, i, shells[i], neighbors[i]));
    array.markers.push_back(axisMarker(header, i, shells[i], neighbors[i] > 0));
  }
  for (const GraspHandle& handle : handles) {
    if (handle.polyline.size() > 1) {
      array.markers.push_back(handleMarker(header, handle));
    }
    array.markers.push_back(idMarker(header, handle));
    if (!handle.hand_poses.empty()) {
      array.markers.push_back(handsMarker(header, handle, config));
    }
  }
  if (config.workspace.isLimit()) {
    std_msgs::Header workspace_header = header;
    workspace_header.frame_id = workspace_frame;
    array.markers.push_back(workspaceMarker(workspace_header, config.workspace));
  }
  deleteSurplus(array, header);
  return array;
}

void LocalizationMarkers::deleteSurplus(visualization_msgs::MarkerArray& array, const std_msgs::Header& header)
{
  std::set<std::pair<std::string, std::int32_t>> shown;
  for (const Marker& marker : array.markers) {
    if (marker.action == Marker::ADD) {
      shown.emplace(marker.ns, marker.id);
    }
  }
  for (auto it = known_.begin(); it != known_.end();) {
    const auto& [ns, id] = it->first;
    auto& left = it->second;
    if (shown.count(it->first) == 0) {
      array.markers.push_back(removal(header, ns, id, Marker::DELETE));
      --left;
    }
    it = left > 0 ? std::next(it) : known_.erase(it);
  }
  for (const auto& key : shown) {
    known_[key] = kDeletions;
  }
}

}  // namespace grasp_affordances
