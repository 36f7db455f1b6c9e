#include "core/handle_finder.h"

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{
namespace
{

/// Distance of one shell's centroid from another one's axis, and along it beyond its end.
bool follows(const Shell& a, const Shell& b, const HandlesConfig& config)
{
  const Eigen::Vector3d offset = b.centroid - a.centroid;
  const double along = offset.dot(a.axis);
  const double across = (offset - along * a.axis).norm();
  return std::abs(a.axis.dot(b.axis)) >= std::cos(config.max_angle) && across <= config.max_distance &&
         std::abs(along) <= (a.length + b.length) / 2 + config.max_gap &&
         std::abs(a.inner_radius - b.inner_radius) <= config.max_radius_difference;
}

}  // namespace

void HandleFinder::find(const PreparedViews& /*views*/, const Config& config, const std::vector<Shell>& shells,
                        std::vector<GraspHandle>& handles)
{
  handles.clear();
  groups_.clear();
  std::vector<bool> grouped(shells.size(), false);
  for (std::uint32_t first = 0; first < shells.size(); ++first) {
    if (grouped[first]) {
      continue;
    }
    grouped[first] = true;
    groups_.push_back({first});
    auto& group = groups_.back();
    for (std::size_t next = 0; next < group.size(); ++next) {
      for (std::uint32_t i = 0; i < shells.size(); ++i) {
        if (!grouped[i] && (follows(shells[group[next]], shells[i], config.handles) ||
                            follows(shells[i], shells[group[next]], config.handles))) {
          grouped[i] = true;
          group.push_back(i);
        }
      }
    }
    std::sort(group.begin(), group.end());
  }
  std::sort(groups_.begin(), groups_.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  for (const auto& group : groups_) {
    if (group.size() < static_cast<std::size_t>(config.handles.min_support)) {
      continue;
    }
    GraspHandle handle;
    const Shell& shell = shells[group.front()];
    handle.id = static_cast<std::uint32_t>(handles.size() + 1);
    handle.centroid = shell.centroid;
    handle.axis = shell.axis;
    handle.normal = shell.normal;
    handle.radius = shell.inner_radius;
    handle.inner_radius = shell.inner_radius;
    handle.length = shell.length;
    handle.polyline = {shell.centroid - shell.length / 2 * shell.axis, shell.centroid + shell.length / 2 * shell.axis};
    handle.shells = group;
    handle.clearance = 1.0;
    handle.observed_free = shell.observed_free;
    handle.score = static_cast<double>(group.size()) / static_cast<double>(group.size() + 5);
    handles.push_back(handle);
  }
}

}  // namespace grasp_affordances
