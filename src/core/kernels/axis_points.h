#pragma once

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// Pixels [begin, end) of a row, as indices into an organized cloud's arrays.
struct PixelSpan
{
  std::size_t begin, end;
};

/// A piece of a cylinder, for a first choice of points in single precision. It must be so much too large that rounding
/// leaves out no point. Metres.
struct CylinderBounds
{
  float origin[3], axis[3];  ///< unit axis
  float begin, end;          ///< along the axis, from the origin
  float squared_radius;
  float nearest, farthest;  ///< z of its points
};

/// How many numbers the first two kernels may write beyond the last valid one.
constexpr std::size_t kChoiceSlack = 16;

/// The chosen points: their coordinates, and their place along the axis. Arrays with room for all points that are
/// chosen from, and kChoiceSlack more.
struct ChosenPoints
{
  float *x, *y, *z, *along;
};

/// Copies the points that lie within the bounds, in the order of their indices. NaN lies within none.
/// @param points coordinates, three arrays of `size`. @return how many
std::size_t chooseInCylinder(const float* const points[3], std::size_t size, const PixelSpan* spans,
                             std::size_t span_count, const CylinderBounds& bounds, const ChosenPoints& chosen);

/// Slices of one thickness (m) that follow one another along the axis, for a second choice in single precision.
struct SliceRow
{
  float begin, thickness;
  float rounding;  ///< m, largest rounding error of a place along the axis
  std::size_t count;
};

/// Deals chosen points out to slices, in their order. Points so near a border that rounding may put them on the wrong
/// side are dealt to the slices on both sides, points beyond an end to the slice at that end. Where a slice gets more
/// than `room` - kChoiceSlack points, its content is unspecified.
/// @param dealt coordinates: three arrays with `room` numbers for each slice. @param sizes of the slices, out
void dealToSlices(const ChosenPoints& chosen, std::size_t count, const SliceRow& slices, float* const dealt[3],
                  std::size_t room, std::size_t* sizes);

/// An axis, and the two directions across it: orthonormal.
struct AxisFrame
{
  double origin[3], axis[3], first[3], second[3];
};

/// Points in the frame of an axis, metres along and across it. The size of the arrays is a multiple of kAxisPointGroup:
/// they are filled up with points that are farther from the axis than anything.
constexpr std::size_t kAxisPointGroup = 8;
struct AxisPoints
{
  const double *along, *first, *second;
  std::size_t size;
};
struct AxisPointArrays
{
  double *along, *first, *second;
};

/// Takes those of `count` points that lie at [begin, end) along the axis into its frame, in double precision. `points`
/// and `taken` have room for kAxisPointGroup more numbers.
/// @return the size of `taken`, a multiple of kAxisPointGroup
std::size_t takeSlice(const float* const points[3], std::size_t count, const AxisFrame& frame, double begin, double end,
                      const AxisPointArrays& taken);

/// A part of a shell about a line along the axis, at `center` across it.
struct ShellBounds
{
  double center[2];
  double begin, end;      ///< along the axis, both included
  double squared_filled;  ///< points up to this radius do not fill the shell; negative: no such points
  double squared_inner, squared_outer;
  double reach;  ///< farthest of its points from the axis
};

/// How many points between begin and end are within each of the radii.
struct ShellCounts
{
  std::uint32_t short_of_filled = 0, inside = 0, up_to_outer = 0;

  void operator+=(const ShellCounts& other)
  {
    short_of_filled += other.short_of_filled;
    inside += other.inside;
    up_to_outer += other.up_to_outer;
  }
};
ShellCounts countPoints(const AxisPoints& points, const ShellBounds& shell);

/// Places along the axis of the first and the last point within the inner radius; infinity and -infinity for none.
struct AlongRange
{
  double first, last;
};
AlongRange insideRange(const AxisPoints& points, const ShellBounds& shell);

/// Sums over points of 1, x, y, xx, xy, yy, sx, sy and ss, where x and y are across the axis and s = xx + yy; in parts.
constexpr int kPlaneMoments = 9;
struct PlaneMomentParts
{
  alignas(64) double of[kPlaneMoments][kAxisPointGroup] = {};
};

/// Adds the moments of the points within the inner radius.
void addMoments(const AxisPoints& points, const ShellBounds& shell, PlaneMomentParts& sums);

}  // namespace grasp_affordances
