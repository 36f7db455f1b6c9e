#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localization.h"

#include <cstdint>
#include <map>
#include <vector>

namespace grasp_affordances::test
{

/// Number of the cloud's points per label within a shell's length and its inner radius + 2 mm.
inline std::map<std::uint32_t, int> labelsWithin(const Shell& shell, const Cloud& cloud,
                                                 const std::vector<std::uint32_t>& labels)
{
  std::map<std::uint32_t, int> counts;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.point(i).cast<double>() - shell.centroid;
    const double along = p.dot(shell.axis);
    if (std::abs(along) <= shell.length / 2 && (p - along * shell.axis).norm() <= shell.inner_radius + 0.002) {
      ++counts[labels[i]];
    }
  }
  return counts;
}

/// The affordance that a shell finds: the one with most points, where the points of affordances are no fewer than the
/// others. 0: none, the shell is wrong. Labels: 0 is not graspable.
inline std::uint32_t affordanceFound(const Shell& shell, const Cloud& cloud, const std::vector<std::uint32_t>& labels)
{
  int graspable = 0, other = 0, most = 0;
  std::uint32_t found = 0;
  for (const auto& [label, count] : labelsWithin(shell, cloud, labels)) {
    (label == 0 ? other : graspable) += count;
    if (label != 0 && count > most) {
      most = count;
      found = label;
    }
  }
  return graspable > 0 && graspable >= other ? found : 0;
}

}  // namespace grasp_affordances::test
