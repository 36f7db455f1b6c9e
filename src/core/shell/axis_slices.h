#pragma once

#include "core/kernels/axis_points.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/shell/cylinder_window.h"

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Slices of equal thickness across an axis. Each begins where the one before ends.
struct Slices
{
  std::size_t count = 1;
  double thickness = 0.0;  ///< m
  double begin = 0.0;      ///< m, of the first slice along the axis

  double beginOf(std::size_t slice) const { return begin + static_cast<double>(slice) * thickness; }
  double endOf(std::size_t slice) const { return beginOf(slice + 1); }
};

/// The points of a cloud about an axis, slice by slice. Only the points of slices that are asked for are gathered, and
/// only up to the distance from the axis that is asked for. Keeps its memory from axis to axis.
class AxisSlices
{
public:
  /// Starts with another axis.
  /// @param search  of the cloud; must exist until the next start. Null: a cloud without points
  /// @param radius  m, the largest distance from the axis that is asked for
  void start(const NeighborhoodSearch* search, const AxisFrame& frame, const Slices& slices, double radius);

  /// The points of a slice that are at most `reach` (m) from the axis, but not those beyond the radius given to
  /// start(). Some points that are farther from the axis may be among them.
  AxisPoints get(std::size_t slice, double reach);

private:
  struct Taken
  {
    double reach = -1.0;  // m, of the points that were gathered; negative before that
    std::size_t begin = 0, size = 0;
  };

  void gatherAround(std::size_t slice, double reach);
  std::size_t chooseInWindow(const RangeImage& image, const CylinderPiece& piece, const CylinderBounds& bounds);
  std::size_t chooseInSphere(const CylinderPiece& piece, const CylinderBounds& bounds);
  ChosenPoints roomToChoose(std::size_t count);
  void dealOut(std::size_t chosen, std::size_t first, std::size_t last, double reach, double rounding);

  const NeighborhoodSearch* search_ = nullptr;
  AxisFrame frame_{};
  Slices slices_;
  double radius_ = 0.0;
  std::vector<Taken> taken_;  // of each slice
  std::vector<double> along_, first_, second_;
  std::size_t size_ = 0;  // of these three arrays, in use
  std::vector<PixelSpan> spans_;
  std::vector<float> chosen_;             // four arrays
  std::vector<float> dealt_;              // three arrays
  std::size_t room_ = 17 * kChoiceSlack;  // of a slice in each array of dealt_; grows
  std::vector<std::size_t> sizes_;        // of the slices in dealt_
  Neighborhood sphere_;
};

}  // namespace grasp_affordances
