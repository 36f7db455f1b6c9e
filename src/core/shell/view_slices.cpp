#include "core/shell/view_slices.h"

#include "core/result/axis_frame.h"

#include <algorithm>

namespace grasp_affordances
{
void ViewSlices::start(const ShellSurroundings& surroundings, const AxisFrame& frame, const Slices& slices,
                       double radius)
{
  count_ = 1 + (surroundings.others != nullptr ? surroundings.others->size() : 0);
  views_.resize(std::max(views_.size(), count_));
  views_[0].points.start(&surroundings.cloud, frame, slices, radius);
  views_[0].hidden.start(surroundings.hidden, frame, slices, radius);
  for (std::size_t i = 1; i < count_; ++i) {
    const OtherView& other = (*surroundings.others)[i - 1];
    const AxisFrame other_frame = transformed(frame, other.T_other_this);
    views_[i].points.start(other.cloud, other_frame, slices, radius);
    views_[i].hidden.start(other.hidden, other_frame, slices, radius);
  }
}

SliceCounts ViewSlices::count(std::size_t slice, const ShellBounds& shell)
{
  SliceCounts counts;
  for (std::size_t i = 0; i < count_; ++i) {
    counts.points += countPoints(views_[i].points.get(slice, shell.reach), shell);
    const AxisPoints hidden = views_[i].hidden.get(slice, shell.reach);
    if (hidden.size > 0) {
      counts.hidden += countPoints(hidden, shell);
    }
  }
  return counts;
}

}  // namespace grasp_affordances
