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

/// Tells how wrong the relative pose of two views is, from the surfaces that both see. It looks for the rigid motion
/// that fits these surfaces best onto one another; if the pose is right, no motion is needed. The method is iterated
/// closest points, with the symmetric point-to-plane distance (Rusinkiewicz 2019), projective association, and robust
/// weights from coarse to fine.
///
/// Deterministic. Keeps its memory from pair to pair; one instance serves one caller at a time.
class ViewAgreement
{
public:
  /// The mean distance (m) by which this motion moves the common points. NaN where the views have too little in common.
  /// Surfaces are looked for up to 6 cm away. So errors of the pose up to some 5 cm are measured; larger errors give a
  /// value that is too small, or NaN.
  ///
  /// Errors that common surfaces do not show are not measured: with a single plane, shifts along it and turns about its
  /// normal.
  double disagreement(const RangeImage& first, const RangeImage& second, const Eigen::Isometry3d& T_first_second);

private:
  /// Two elements, one of each view, that may be of one surface. In the first view's frame.
  struct Pair
  {
    Eigen::Vector3d point_of_second;
    Eigen::Vector3d normal;  // unit, the mean of both
    double distance;         // m, along the normal from the point of the first to that of the second
    double weight;
  };

  /// Where a fit has ended.
  struct Fit
  {
    double support = 0.0;       // number of pairs that are close together then
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
