#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localization.h"
#include "grasp_affordances/range_image.h"

#include <Eigen/Geometry>

#include <cstdint>
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

/// Judges shells by the labels (0: not graspable, 1..: affordance, 255: doubtful) of the points of all views within a
/// shell's length and its inner radius + 2 mm: right where those of affordances are no fewer than the not graspable
/// ones; not counted where the doubtful ones outnumber the not graspable ones; else wrong.
///
/// Refers to clouds and labels, one per point, which must outlive it. Judging is safe from many threads.
class Judge
{
public:
  /// The frame of the cloud is that of the shells.
  Judge(const Cloud& cloud, const std::vector<std::uint32_t>& labels);

  void addView(const Cloud& cloud, const std::vector<std::uint32_t>& labels, const Eigen::Isometry3d& T_shell_cloud);

  Verdict operator()(const Shell& shell) const;

private:
  struct View
  {
    const Cloud* cloud;
    const std::vector<std::uint32_t>* labels;
    Eigen::Isometry3d T_cloud_shell;
    std::optional<RangeImage> image;  // where the cloud has one: only the pixels around a shell are looked at
  };

  std::vector<View> views_;
};

/// Judges one shell; for many on the same cloud use a Judge.
Verdict judge(const Shell& shell, const Cloud& cloud, const std::vector<std::uint32_t>& labels);

}  // namespace grasp_affordances
