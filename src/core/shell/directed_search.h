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

/// FitShell about axes of one direction. See ShellSearch for what it searches.
class DirectedSearch
{
public:
  /// All arguments must outlive the search. `views` and `counts` are working memory.
  DirectedSearch(const ShellSurroundings& surroundings, const HandGeometry& hand, const ShellConfig& config,
                 ViewSlices& views, std::vector<SliceCounts>& counts);

  /// The smallest shell about a cylinder's axis whose radius is not below the cylinder's.
  /// @param cylinder  with the same direction in every call
  ShellSearchResult about(const FittedCylinder& cylinder);

  /// The cylinder fitted to the points inside the shell that was found last; empty where the fit fails.
  std::optional<FittedCylinder> refit() const;

  /// A cylinder of another direction, fitted to the points within the capture radius of the axis and over the clearance
  /// length; empty where they do not determine one.
  std::optional<FittedCylinder> straightened() const;

private:
  /// A row of slices, and the numbers of their points in a shell.
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
  std::vector<SliceCounts>& counts_;  // of each slice, in the shell that was looked at last
  std::optional<AxisFrame> frame_;    // in which the points were gathered
  FittedCylinder cylinder_;           // about which shells are searched
  Extent found_;
  ShellBounds found_bounds_{};
};

}  // namespace grasp_affordances
