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

constexpr std::uint32_t kDoubtful = 255;

struct Verdict
{
  bool right = false;
  bool wrong = false;            // neither: on something doubtful, and not counted
  std::uint32_t affordance = 0;  // that a right shell finds: the one with most points
};

/// Right where the points of affordances (labels from 1 on) are no fewer than those of what is not graspable (label 0);
/// not counted where that is outnumbered by doubtful ones; else wrong.
inline Verdict judge(const Shell& shell, const Cloud& cloud, const std::vector<std::uint32_t>& labels)
{
  int graspable = 0, other = 0, doubtful = 0, most = 0;
  Verdict verdict;
  for (const auto& [label, count] : labelsWithin(shell, cloud, labels)) {
    (label == 0 ? other : label == kDoubtful ? doubtful : graspable) += count;
    if (label != 0 && label != kDoubtful && count > most) {
      most = count;
      verdict.affordance = label;
    }
  }
  verdict.right = graspable > 0 && graspable >= other;
  verdict.wrong = !verdict.right && doubtful <= other;
  verdict.affordance = verdict.right ? verdict.affordance : 0;
  return verdict;
}

}  // namespace grasp_affordances::test
