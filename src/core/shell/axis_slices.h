#pragma once

#include "core/kernels/axis_points.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/shell/cylinder_window.h"

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Slices of one thickness across an axis, one after the other.
struct Slices
{
  std::size_t count = 1;
  double thickness = 0.0;  ///< m
  double begin = 0.0;      ///< m along the axis, of the first

  double beginOf(std::size_t slice) const { return begin + static_cast<double>(slice) * thickness; }
  double endOf(std::size_t slice) const { return beginOf(slice + 1); }
};

/// The points of a cloud about an axis, slice by slice. They are gathered as far along the axis, and from it, as they
/// are asked for. Keeps its memory from axis to axis.
class AxisSlices
{
public:
  /// Starts over. The search must stay until the next start; where it is null there are no points.
  void start(const NeighborhoodSearch* search, const AxisFrame& frame, const Slices& slices, double radius);

  /// The points of a slice up to a distance of `reach` from the axis, but no farther than the radius, and some beyond.
  AxisPoints get(std::size_t slice, double reach);

private:
  struct Taken
  {
    double reach = -1.0;  // m; negative before they are gathered
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
  std::vector<Taken> taken_;  // slices
  std::vector<double> along_, first_, second_;
  std::size_t size_ = 0;  // of these, in use
  std::vector<PixelSpan> spans_;
  std::vector<float> chosen_;             // four arrays
  std::vector<float> dealt_;              // three arrays
  std::size_t room_ = 17 * kChoiceSlack;  // for a slice in each of them; grows
  std::vector<std::size_t> sizes_;        // of the slices dealt
  Neighborhood sphere_;
};

}  // namespace grasp_affordances
