#include "evaluation/judge.h"

#include "core/result/polyline.h"
#include "simulation/grasp_definition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace grasp_affordances
{
namespace
{

constexpr double kMargin = 0.002;  // m beyond the inner radius, for noise of the surface

}  // namespace

const char* verdictName(Verdict::Kind kind)
{
  constexpr std::array<const char*, 3> kNames{"right", "wrong", "not_counted"};
  return kNames[kind];  // cppcheck-suppress CastIntegerToAddressAtReturn; not an integer
}

Judge::Judge(const Cloud& cloud, const std::vector<std::uint32_t>& labels)
{
  addView(cloud, labels, Eigen::Isometry3d::Identity());
}

void Judge::addView(const Cloud& cloud, const std::vector<std::uint32_t>& labels,
                    const Eigen::Isometry3d& T_shell_cloud)
{
  std::string warning;
  views_.push_back({&cloud, &labels, T_shell_cloud, RangeImage::create(cloud, warning)});
}

Verdict Judge::verdict(const LabelCounts& counts)
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

std::optional<std::uint32_t> Judge::commonest(const LabelCounts& counts)
{
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? std::nullopt : std::make_optional(most->first);
}

template <class IsWithin>
Judge::LabelCounts Judge::count(const Eigen::Vector3d& sphere_center, double sphere_radius,
                                const IsWithin& is_within) const
{
  LabelCounts counts;
  for (const View& view : views_) {
    const Cloud& cloud = *view.cloud;
    const auto countRange = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (is_within(view.T_shell_cloud * cloud.point(i).cast<double>())) {
          ++counts[(*view.labels)[i]];
        }
      }
    };
    if (!view.image) {
      countRange(0, cloud.size());
      continue;
    }
    const PixelWindow window = view.image->window(view.T_shell_cloud.inverse() * sphere_center, sphere_radius);
    for (int v = window.v_begin; v < window.v_end; ++v) {
      const std::size_t row = static_cast<std::size_t>(v) * cloud.width;
      countRange(row + static_cast<std::size_t>(window.u_begin), row + static_cast<std::size_t>(window.u_end));
    }
  }
  return counts;
}

Judge::LabelCounts Judge::within(const Shell& shell) const
{
  const double radius = shell.inner_radius + kMargin;
  const auto is_within = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d offset = point - shell.centroid;
    const double along = offset.dot(shell.axis);
    return std::abs(along) <= shell.length / 2 && (offset - along * shell.axis).norm() <= radius;  // false for NaN
  };
  return count(shell.centroid, std::hypot(shell.length / 2, radius), is_within);
}

Judge::LabelCounts Judge::within(const GraspHandle& handle) const
{
  if (handle.polyline.size() < 2) {
    return {};
  }
  const double radius = handle.inner_radius + kMargin;
  const auto is_within = [&](const Eigen::Vector3d& point) {
    if (!point.allFinite()) {
      return false;
    }
    const PolylinePlace place = nearestPlace(handle.polyline, point);
    return !place.is_beyond_end && place.offset.norm() <= radius;
  };
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : handle.polyline) {
    box.extend(point);
  }
  return count(box.center(), box.diagonal().norm() / 2 + radius, is_within);
}

Verdict Judge::operator()(const Shell& shell) const
{
  return verdict(within(shell));
}

Verdict Judge::operator()(const GraspHandle& handle) const
{
  return verdict(within(handle));
}

std::optional<std::uint32_t> Judge::commonest(const Shell& shell) const
{
  return commonest(within(shell));
}

std::optional<std::uint32_t> Judge::commonest(const GraspHandle& handle) const
{
  return commonest(within(handle));
}

Verdict judge(const Shell& shell, const Cloud& cloud, const std::vector<std::uint32_t>& labels)
{
  return Judge(cloud, labels)(shell);
}

}  // namespace grasp_affordances
