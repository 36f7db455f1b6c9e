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

/// A piece of a cylinder, for a first choice of points in single precision: what rounding might misjudge belongs in its
/// bounds. Metres.
struct CylinderBounds
{
  float origin[3], axis[3];  ///< unit axis
  float begin, end;          ///< along the axis, from the origin
  float squared_radius;
  float nearest, farthest;  ///< z of its points
};

/// Numbers that the first two kernels may write beyond the last one that counts.
constexpr std::size_t kChoiceSlack = 16;

/// Points chosen: coordinates, and place along the axis. Arrays with room for all points chosen from and kChoiceSlack
/// more.
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
  float rounding;  ///< m, by which places along the axis may be wrong
  std::size_t count;
};

/// Deals chosen points out to slices, in their order; those so near a border that rounding might misjudge them to the
/// slices on both sides, those beyond the ends to the last slices. Where a slice has more than `room` - kChoiceSlack
/// points, what it is dealt is unspecified.
/// @param dealt coordinates: three arrays with `room` numbers for each slice. @param sizes of the slices, out
void dealToSlices(const ChosenPoints& chosen, std::size_t count, const SliceRow& slices, float* const dealt[3],
                  std::size_t room, std::size_t* sizes);

/// An axis, and the two directions across it: orthonormal.
struct AxisFrame
{
  double origin[3], axis[3], first[3], second[3];
};

/// Points in the frame of an axis, metres along and across it. Arrays whose size is a multiple of kAxisPointGroup: what
/// fills them up is out of any reach of the axis.
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

/// Takes into the axis' frame, in double precision, those of `count` points that lie at [begin, end) along it. `points`
/// have room for kAxisPointGroup numbers more, `taken` too.
/// @return the size that is taken, a multiple of kAxisPointGroup
std::size_t takeSlice(const float* const points[3], std::size_t count, const AxisFrame& frame, double begin, double end,
                      const AxisPointArrays& taken);

/// A part of a shell about a line along the axis, at `center` across it.
struct ShellBounds
{
  double center[2];
  double begin, end;      ///< along the axis, both included
  double squared_filled;  ///< points up to this radius leave the shell unfilled; negative for none
  double squared_inner, squared_outer;
  double reach;  ///< farthest of its points from the axis
};

/// Numbers of points between begin and end, up to each of the radii.
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

/// Places along the axis of the first and last point inside the inner radius; infinity and -infinity for none.
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

/// Adds the points inside the inner radius.
void addMoments(const AxisPoints& points, const ShellBounds& shell, PlaneMomentParts& sums);

}  // namespace grasp_affordances
