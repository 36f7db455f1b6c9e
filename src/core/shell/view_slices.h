#pragma once

#include "core/kernels/axis_points.h"
#include "core/shell/axis_slices.h"
#include "core/shell/shell.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What a shell holds of a slice.
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

/// The points about an axis in all views, slice by slice: places along the axis and across it are the same in the
/// frames of all views. Keeps its memory from axis to axis.
class ViewSlices
{
public:
  /// Starts over about an axis in the frame of the surroundings, which must stay until the next start.
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

  std::vector<View> views_;  // the surroundings' own first; more than there are now, perhaps
  std::size_t count_ = 0;
};

}  // namespace grasp_affordances
