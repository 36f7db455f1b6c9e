#include "evaluation/judge.h"

#include "simulation/ground_truth.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

namespace grasp_affordances
{
namespace
{

constexpr double kMargin = 0.002;  // m beyond the inner radius, for noise of the surface

using LabelCounts = std::map<std::uint32_t, std::size_t>;

Verdict verdict(const LabelCounts& counts)
{
  std::size_t graspable = 0, other = 0, doubtful = 0, most = 0;
  std::uint32_t affordance = 0;
  for (const auto& [label, count] : counts) {
    if (label == kNotGraspable) {
      other = count;
    } else if (label == kDoubtful) {
      doubtful = count;
    } else {
      graspable += count;
      if (count > most) {
        most = count;
        affordance = label;
      }
    }
  }
  if (graspable > 0 && graspable >= other) {
    return {Verdict::right, affordance};
  }
  return {doubtful > other ? Verdict::not_counted : Verdict::wrong, 0};
}

}  // namespace

const char* verdictName(Verdict::Kind kind)
{
  constexpr std::array<const char*, 3> kNames{"right", "wrong", "not_counted"};
  return kNames[kind];
}

Judge::Judge(const Cloud& cloud, const std::vector<std::uint32_t>& labels)
{
  addView(cloud, labels, Eigen::Isometry3d::Identity());
}

void Judge::addView(const Cloud& cloud, const std::vector<std::uint32_t>& labels,
                    const Eigen::Isometry3d& T_shell_cloud)
{
  std::string warning;
  views_.push_back({&cloud, &labels, T_shell_cloud.inverse(), RangeImage::create(cloud, warning)});
}

Verdict Judge::operator()(const Shell& shell) const
{
  const double radius = shell.inner_radius + kMargin;
  LabelCounts counts;
  for (const View& view : views_) {
    const Cloud& cloud = *view.cloud;
    const Eigen::Vector3d centroid = view.T_cloud_shell * shell.centroid;
    const Eigen::Vector3d axis = view.T_cloud_shell.linear() * shell.axis;
    const auto countRange = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Eigen::Vector3d offset = cloud.point(i).cast<double>() - centroid;
        const double along = offset.dot(axis);
        if (std::abs(along) <= shell.length / 2 && (offset - along * axis).norm() <= radius) {  // false for NaN
          ++counts[(*view.labels)[i]];
        }
      }
    };
    if (!view.image) {
      countRange(0, cloud.size());
      continue;
    }
    const PixelWindow window = view.image->window(centroid, std::hypot(shell.length / 2, radius));
    for (int v = window.v_begin; v < window.v_end; ++v) {
      const std::size_t row = static_cast<std::size_t>(v) * cloud.width;
      countRange(row + static_cast<std::size_t>(window.u_begin), row + static_cast<std::size_t>(window.u_end));
    }
  }
  return verdict(counts);
}

Verdict judge(const Shell& shell, const Cloud& cloud, const std::vector<std::uint32_t>& labels)
{
  return Judge(cloud, labels)(shell);
}

}  // namespace grasp_affordances
