#pragma once

#include "core/cloud/range_image.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localization.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// What a shell turned out to be.
struct Verdict
{
  enum Kind
  {
    right,
    wrong,
    not_counted  ///< on something doubtful
  };
  Kind kind = wrong;
  std::uint32_t affordance = 0;  ///< label that a right shell finds: the one with most points within it; else 0
};

/// "right", "wrong" or "not_counted".
const char* verdictName(Verdict::Kind kind);

/// Judges shells and handles by the labels (0: not graspable, 1..: affordance, 255: doubtful) of the points of all
/// views within: right where those of affordances are no fewer than the not graspable ones; not counted where the
/// doubtful ones outnumber the not graspable ones; else wrong. Within a shell are the points within its length and its
/// inner radius + 2 mm. Within a handle are those at most its inner radius + 2 mm from its polyline and not beyond its
/// ends, that is, beyond the planes at right angles to its first and its last segment there.
///
/// Refers to clouds and labels, one per point, which must outlive it. Judging is safe from many threads.
class Judge
{
public:
  /// The frame of the cloud is that of the shells.
  Judge(const Cloud& cloud, const std::vector<std::uint32_t>& labels);

  void addView(const Cloud& cloud, const std::vector<std::uint32_t>& labels, const Eigen::Isometry3d& T_shell_cloud);

  Verdict operator()(const Shell& shell) const;

  /// One whose polyline has fewer than two points holds none.
  Verdict operator()(const GraspHandle& handle) const;

  /// The label that most points within have, the smallest of several; empty where no point is within.
  std::optional<std::uint32_t> commonest(const Shell& shell) const;
  std::optional<std::uint32_t> commonest(const GraspHandle& handle) const;

private:
  struct View
  {
    const Cloud* cloud;
    const std::vector<std::uint32_t>* labels;
    Eigen::Isometry3d T_shell_cloud;
    std::optional<RangeImage> image;  // where the cloud has one: only the pixels around a shell are looked at
  };
  using LabelCounts = std::map<std::uint32_t, std::size_t>;

  /// Of the points for which is_within(point in the frame of the shells) holds, all of which are in the sphere.
  template <class IsWithin>
  LabelCounts count(const Eigen::Vector3d& sphere_center, double sphere_radius, const IsWithin& is_within) const;
  LabelCounts within(const Shell& shell) const;
  LabelCounts within(const GraspHandle& handle) const;
  static Verdict verdict(const LabelCounts& counts);
  static std::optional<std::uint32_t> commonest(const LabelCounts& counts);

  std::vector<View> views_;
};

/// Judges one shell; for many on the same cloud use a Judge.
Verdict judge(const Shell& shell, const Cloud& cloud, const std::vector<std::uint32_t>& labels);

}  // namespace grasp_affordances
