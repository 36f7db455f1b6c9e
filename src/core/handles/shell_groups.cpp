#include "core/handles/shell_groups.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

/// Where the axes of two shells come closest within their lengths: places along the axes, from the middles (m).
struct Approach
{
  double on_a, on_b;
  double distance;
};

Approach closestApproach(const Shell& a, double half_a, const Shell& b, double half_b)
{
  const Eigen::Vector3d offset = b.centroid - a.centroid;
  const double cosine = a.axis.dot(b.axis), along_a = offset.dot(a.axis), along_b = offset.dot(b.axis);
  const double determinant = 1.0 - cosine * cosine;
  constexpr double kParallel = 1e-9;
  Approach closest{};
  closest.on_a = determinant > kParallel ? (along_a - cosine * along_b) / determinant : 0.0;
  closest.on_a = std::clamp(closest.on_a, -half_a, half_a);
  closest.on_b = std::clamp(closest.on_a * cosine - along_b, -half_b, half_b);
  closest.on_a = std::clamp(along_a + closest.on_b * cosine, -half_a, half_a);
  closest.distance = (offset + closest.on_b * b.axis - closest.on_a * a.axis).norm();
  return closest;
}

/// Whether a place is in the outer parts of a shell's length. There a bent handle may go on in another direction.
bool isNearEnd(double place, const Shell& shell)
{
  constexpr double kOuterShare = 0.35;
  return std::abs(place) >= (0.5 - kOuterShare) * shell.length;
}

}  // namespace

bool shareAxis(const Shell& a, const Shell& b, const HandlesConfig& config)
{
  if (std::abs(a.inner_radius - b.inner_radius) > config.max_radius_difference) {
    return false;
  }
  const bool aligned = std::abs(a.axis.dot(b.axis)) >= std::cos(config.max_angle);
  const Approach closest = closestApproach(a, a.length / 2, b, b.length / 2);
  const bool at_ends = isNearEnd(closest.on_a, a) && isNearEnd(closest.on_b, b);
  if (closest.distance <= config.max_distance && (aligned || at_ends)) {
    return true;
  }
  constexpr double kStep = 0.003;  // m
  const bool stepped = std::abs(a.inner_radius - b.inner_radius) > kStep;
  if (stepped && at_ends && closest.distance <= config.max_gap) {
    return true;
  }
  constexpr double kMostElongated = 2.0;  // lengths over diameters
  constexpr double kNear = 0.5;           // radii
  const double radius = std::min(a.inner_radius, b.inner_radius);
  return std::max(a.length, b.length) <= kMostElongated * 2.0 * radius &&
         (a.centroid - b.centroid).norm() <= kNear * radius;
}

std::uint32_t ShellGroups::rootOf(std::uint32_t shell)
{
  while (parents_[shell] != shell) {
    parents_[shell] = parents_[parents_[shell]];
    shell = parents_[shell];
  }
  return shell;
}

void ShellGroups::update(const std::vector<Shell>& shells, const HandlesConfig& config,
                         const Cancellation& cancellation)
{
  const auto count = static_cast<std::uint32_t>(shells.size());
  parents_.resize(count);
  x_.resize(count);
  y_.resize(count);
  z_.resize(count);
  double longest = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) {
    parents_[i] = i;
    x_[i] = static_cast<float>(shells[i].centroid.x());
    y_[i] = static_cast<float>(shells[i].centroid.y());
    z_[i] = static_cast<float>(shells[i].centroid.z());
    longest = std::max(longest, shells[i].length);
  }
  const auto reach = static_cast<float>(1.01 * (longest + config.max_gap + config.max_distance));
  for (std::uint32_t i = 0; i < count; ++i) {
    cancellation.check();
    for (std::uint32_t j = 0; j < i; ++j) {
      const float dx = x_[i] - x_[j], dy = y_[i] - y_[j], dz = z_[i] - z_[j];
      if (dx * dx + dy * dy + dz * dz > reach * reach) {
        continue;
      }
      // The smaller index is the root, so that the order in which groups are joined does not matter.
      const std::uint32_t a = rootOf(i), b = rootOf(j);
      if (a != b && shareAxis(shells[i], shells[j], config)) {
        parents_[std::max(a, b)] = std::min(a, b);
      }
    }
  }

  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  groups_.assign(count, kNone);
  begins_.assign(1, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t root = rootOf(i);
    if (groups_[root] == kNone) {
      groups_[root] = static_cast<std::uint32_t>(begins_.size() - 1);
      begins_.push_back(0);
    }
    ++begins_[groups_[root] + 1];
  }
  for (std::size_t group = 1; group < begins_.size(); ++group) {
    begins_[group] += begins_[group - 1];
  }
  members_.resize(count);
  for (std::uint32_t i = count; i-- > 0;) {
    members_[--begins_[groups_[rootOf(i)] + 1]] = i;
  }
  // Each begin but the first now holds the begin of the group before it.
  begins_.erase(begins_.begin());
  begins_.push_back(count);
}

}  // namespace grasp_affordances
