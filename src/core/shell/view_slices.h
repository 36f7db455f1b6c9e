#pragma once

#include "core/kernels/axis_points.h"
#include "core/shell/axis_slices.h"
#include "core/shell/shell.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// The numbers of a slice's points in a shell: those that were measured, and those of hidden surfaces.
struct SliceCounts
{
  ShellCounts points, hidden;

  void operator+=(const SliceCounts& other)
  {
    points += other.points;
    hidden += other.hidden;
  }
  std::uint32_t inGap() const { return points.up_to_outer - points.inside; }
  std::uint32_t hiddenInGap() const { return hidden.up_to_outer - hidden.inside; }
};

/// The points about an axis in all views, slice by slice. Their coordinates along the axis and across it are the same,
/// whichever view measured them. Keeps its memory from axis to axis.
class ViewSlices
{
public:
  /// Starts with another axis.
  /// @param surroundings  must exist until the next start
  /// @param frame  of the axis, given in the frame of the surroundings
  void start(const ShellSurroundings& surroundings, const AxisFrame& frame, const Slices& slices, double radius);

  /// Calls visit(points) with the measured points of each view; see AxisSlices::get.
  template <typename Visitor>
  void visitPoints(std::size_t slice, double reach, Visitor&& visit)
  {
    for (std::size_t i = 0; i < count_; ++i) {
      visit(views_[i].points.get(slice, reach));
    }
  }

  SliceCounts count(std::size_t slice, const ShellBounds& shell);

private:
  struct View
  {
    AxisSlices points, hidden;
  };

  std::vector<View> views_;  // the first count_ are in use, and the first of all is the surroundings' own
  std::size_t count_ = 0;
};

}  // namespace grasp_affordances
