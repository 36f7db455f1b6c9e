#include "nodelets/selection/hand_pose_choice.h"

#include "core/result/axis_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kLever = 0.05;      // m: a radian between approaches is as far as this along the axis
constexpr double kSameAngle = 0.25;  // rad, below half a step of the default ring: still the same approach
constexpr double kSameAlong = 0.02;  // m
constexpr double kAngleStep = 0.1;   // rad, within which approaches count as one direction

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

HandPoseChoice::Place HandPoseChoice::place(const GraspHandle& handle, std::size_t index,
                                            const Eigen::Isometry3d& T_hand_tool)
{
  const Eigen::Isometry3d hand = handle.hand_poses[index].pose * T_hand_tool.inverse();
  return {hand.linear().col(0), handle.axis, (hand.translation() - handle.centroid).dot(handle.axis)};
}

std::optional<std::size_t> HandPoseChoice::follow(const GraspHandle& handle, const Eigen::Isometry3d& T_hand_tool)
{
  if (handle.hand_poses.empty()) {
    return std::nullopt;
  }
  if (!wanted_) {
    wanted_ = place(handle, 0, T_hand_tool);
    return 0;
  }
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  bool same = false;
  for (std::size_t i = 0; i < handle.hand_poses.size(); ++i) {
    const Place candidate = place(handle, i, T_hand_tool);
    // The axis of a handle is one of two directions, which may turn over between clouds.
    const double sign = candidate.axis.dot(wanted_->axis) < 0.0 ? -1.0 : 1.0;
    const double angle = angleBetween(candidate.approach, wanted_->approach);
    const double along = std::abs(sign * candidate.along - wanted_->along);
    if (kLever * angle + along < least) {
      least = kLever * angle + along;
      nearest = i;
      same = angle <= kSameAngle && along <= kSameAlong;
    }
  }
  if (same) {
    wanted_ = place(handle, nearest, T_hand_tool);
  }
  return nearest;
}

std::optional<std::size_t> HandPoseChoice::step(const GraspHandle& handle, const Eigen::Isometry3d& T_hand_tool,
                                                bool backwards)
{
  const std::optional<std::size_t> current = follow(handle, T_hand_tool);
  if (!current) {
    return std::nullopt;
  }
  const Eigen::Vector3d normal = normalOrAny(handle.axis, handle.normal);
  const Eigen::Vector3d across = handle.axis.cross(normal);
  const auto key = [&](std::size_t i) {
    const Place p = place(handle, i, T_hand_tool);
    const double angle = std::atan2(p.approach.dot(across), p.approach.dot(normal));
    return std::make_tuple(std::round(angle / kAngleStep), p.along, i);
  };
  std::vector<std::size_t> ring(handle.hand_poses.size());
  std::iota(ring.begin(), ring.end(), 0);
  std::sort(ring.begin(), ring.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  const std::size_t position = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), *current) - ring.begin());
  const std::size_t chosen = ring[(position + (backwards ? ring.size() - 1 : 1)) % ring.size()];
  wanted_ = place(handle, chosen, T_hand_tool);
  return chosen;
}

}  // namespace grasp_affordances
