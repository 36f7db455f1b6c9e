#pragma once

#include "core/cloud/range_image.h"
#include "core/parallel/thread_team.h"
#include "core/views/surface_elements.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Tells how wrong the relative pose of two views is, from the surfaces that both see: the rigid motion that fits them
/// best onto one another (iterated closest points with the symmetric point-to-plane distance of Rusinkiewicz 2019,
/// projective association, robust weights from coarse to fine) would vanish were the pose right.
///
/// Deterministic. Keeps its memory from pair to pair; one instance serves one caller at a time.
class ViewAgreement
{
public:
  /// Mean length (m) of the way that this motion takes the common points. Surfaces are looked for up to 6 cm away:
  /// errors of the pose up to some 5 cm are measured, larger ones only noticed, if at all. NaN where the views have too
  /// little in common.
  ///
  /// What common surfaces do not tell is taken for right: with a single plane, shifts along it and turns about its
  /// normal.
  double disagreement(const RangeImage& first, const RangeImage& second, const Eigen::Isometry3d& T_first_second);

private:
  /// Two elements of what may be one surface, in the first view's frame.
  struct Pair
  {
    Eigen::Vector3d point_of_second;
    Eigen::Vector3d normal;  // of both
    double distance;         // m, of the second's from the first's along the normal
    double weight;
  };

  /// Where a fit has ended.
  struct Fit
  {
    double support = 0.0;       // pairs that it leaves close together
    double displacement = 0.0;  // m, mean over them
  };

  Fit fit(const Eigen::Isometry3d& T_first_second, double gate);
  void findPairs(const Eigen::Isometry3d& T_first_second, double gate);
  void addPair(const SurfaceElement& first, const SurfaceElement& second, const Eigen::Isometry3d& T_first_second,
               double gate);
  Eigen::Isometry3d motionToFit() const;

  SurfaceElements first_, second_;
  std::vector<Pair> pairs_;
};

/// One view of a moment, as ViewComparison takes it.
struct ComparedView
{
  std::size_t number;       ///< that warnings call it by
  const RangeImage* image;  ///< null for a cloud without one, which is compared with no other
  Eigen::Isometry3d T_common_view;
};

/// Compares each view of a moment with each other one. Deterministic. Keeps its memory from moment to moment; one
/// instance serves one caller at a time.
class ViewComparison
{
public:
  /// Compares the views, the pairs shared out among the team. The images must outlive the call only.
  void compare(const std::vector<ComparedView>& views, ThreadTeam& team);

  /// The largest ViewAgreement::disagreement (m) of all pairs; NaN where no pair could be compared.
  double disagreement() const { return disagreement_; }

  /// One line for each pair whose poses are probably wrong.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  struct Pair
  {
    std::size_t first, second;  // places among the views
    double disagreement;        // m
    ViewAgreement agreement;
  };

  std::vector<Pair> pairs_;
  double disagreement_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> warnings_;
};

}  // namespace grasp_affordances
