#include "rendering/picture.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

using Indices = std::vector<std::size_t>;

constexpr std::array<Color, 6> kPalette{{{1.00F, 0.62F, 0.05F},
                                         {0.15F, 0.85F, 0.95F},
                                         {0.60F, 0.95F, 0.20F},
                                         {1.00F, 0.35F, 0.65F},
                                         {0.70F, 0.55F, 1.00F},
                                         {1.00F, 0.95F, 0.30F}}};

bool holdsCentroidOf(const Shell& shell, const Shell& other)
{
  const Eigen::Vector3d offset = other.centroid - shell.centroid;
  const double along = offset.dot(shell.axis);
  return std::abs(along) < shell.length / 2 && (offset - along * shell.axis).norm() < shell.inner_radius;
}

/// Shells of which one holds the other's centroid are of one group; the largest group first.
std::vector<Indices> groupOverlapping(const std::vector<Shell>& shells)
{
  std::vector<Indices> groups;
  std::vector<bool> grouped(shells.size(), false);
  for (std::size_t seed = 0; seed < shells.size(); ++seed) {
    if (grouped[seed]) {
      continue;
    }
    Indices group{seed};
    grouped[seed] = true;
    for (std::size_t next = 0; next < group.size(); ++next) {
      const Shell& member = shells[group[next]];
      for (std::size_t i = 0; i < shells.size(); ++i) {
        if (!grouped[i] && (holdsCentroidOf(shells[i], member) || holdsCentroidOf(member, shells[i]))) {
          grouped[i] = true;
          group.push_back(i);
        }
      }
    }
    groups.push_back(group);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Indices& a, const Indices& b) { return a.size() > b.size(); });
  return groups;
}

/// The member that differs least from the others, in place and direction.
std::size_t mostTypical(const std::vector<Shell>& shells, const Indices& group)
{
  std::size_t best = group.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t candidate : group) {
    double sum = 0.0;
    for (const std::size_t other : group) {
      const Shell& a = shells[candidate];
      const Shell& b = shells[other];
      sum += (a.centroid - b.centroid).norm() + a.inner_radius * a.axis.cross(b.axis).norm();
    }
    if (sum < least) {
      least = sum;
      best = candidate;
    }
  }
  return best;
}

}  // namespace

void drawShells(Picture& picture, const std::vector<Shell>& shells)
{
  const std::vector<Indices> groups = groupOverlapping(shells);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    ShellStyle faint;
    faint.color = kPalette[g % kPalette.size()];
    faint.line_opacity = std::clamp(1.0 / std::sqrt(static_cast<double>(groups[g].size())), 0.08, 0.5);
    faint.fill_opacity = 0.1 * faint.line_opacity;
    faint.line_width = 1.0;
    faint.gap = false;
    for (const std::size_t i : groups[g]) {
      picture.drawShell(shells[i], faint);
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    ShellStyle bold;
    bold.color = kPalette[g % kPalette.size()];
    bold.fill_opacity = 0.3;
    bold.line_width = 3.0;
    picture.drawShell(shells[mostTypical(shells, groups[g])], bold);
  }
}

}  // namespace grasp_affordances
