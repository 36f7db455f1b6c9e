#pragma once

#include "grasp_affordances/config.h"

#include "core/cloud/range_image.h"
#include "core/kernels/axis_points.h"
#include "core/shell/axis_slices.h"
#include "core/shell/shell.h"
#include "core/shell/view_slices.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// FitShell about one direction.
class DirectedSearch
{
public:
  /// All of these must outlive it.
  DirectedSearch(const ShellSurroundings& surroundings, const HandGeometry& hand, const ShellConfig& config,
                 ViewSlices& views, std::vector<SliceCounts>& counts);

  /// The smallest shell about a cylinder's axis, from its radius on. Its direction is the same from call to call.
  ShellSearchResult about(const FittedCylinder& cylinder);

  /// The cylinder through the points inside the shell that was found last.
  std::optional<FittedCylinder> refit() const;

  /// A cylinder of another direction, through what the hand's reach about the axis holds over the clearance length.
  std::optional<FittedCylinder> straightened() const;

private:
  /// Slices that follow one another, and what a shell holds of them.
  struct Extent
  {
    std::size_t first_slice = 0, last_slice = 0;
    double begin = 0.0, end = 0.0;  // m, along the axis
    std::uint32_t inside = 0, in_gap = 0, hidden_in_gap = 0;

    double length() const { return end - begin; }
    void add(const SliceCounts& counts)
    {
      inside += counts.points.inside;
      in_gap += counts.inGap();
      hidden_in_gap += counts.hiddenInGap();
    }
  };

  void lookAlong(const FittedCylinder& cylinder);
  ShellBounds boundsOf(double inner_radius) const;
  bool clearAndOccupied(const Extent& extent) const;
  bool unseen(std::size_t slice) const;
  bool unseen(std::size_t slice, const RangeImage* image, const Eigen::Isometry3d& T_image_this) const;
  Extent clearanceExtent(const ShellBounds& shell) const;
  bool graspable(std::size_t slice, const ShellBounds& shell) const;
  Extent measuredExtent(const ShellBounds& shell) const;
  Extent refinedExtent(const Extent& extent, ShellBounds shell) const;

  const ShellSurroundings& surroundings_;
  const HandGeometry& hand_;
  const ShellConfig& config_;
  const Slices slices_;
  const PointThresholds thresholds_;
  ViewSlices& views_;
  std::vector<SliceCounts>& counts_;  // slices, in the shell that was looked at last
  std::optional<AxisFrame> frame_;    // of the points
  FittedCylinder cylinder_;           // that is searched about
  Extent found_;
  ShellBounds found_bounds_{};
};

}  // namespace grasp_affordances
