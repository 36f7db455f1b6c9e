#include "core/kernels/surface_ends.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/surface_ends.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_real.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using LineLanes = Real::D;
static_assert(kScanLines == kRealLanes, "one scan line in each lane");

HWY_ATTR HWY_INLINE Real loadLines(const double* values)
{
  return hn::LoadU(LineLanes(), values);
}

/// The number where a condition holds, zero elsewhere.
HWY_ATTR HWY_INLINE Real onlyWhere(Condition condition, Real value)
{
  return hn::IfThenElseZero(condition, value.lanes);
}

/// Inverse depths and sums of the lines from `line` on, as many as there are lanes.
HWY_ATTR void sumScanLines(const float* depth, std::size_t size, std::size_t line, double* inverse_depth, double* sums)
{
  const LineLanes d;
  const hn::Rebind<float, LineLanes> single;
  Real n(0.0), i(0.0), ii(0.0), y(0.0), iy(0.0);
  for (std::size_t pixel = 0;; ++pixel) {
    double* before = sums + pixel * kLineSums * kScanLines + line;
    hn::StoreU(n.lanes, d, before);
    hn::StoreU(i.lanes, d, before + kScanLines);
    hn::StoreU(ii.lanes, d, before + 2 * kScanLines);
    hn::StoreU(y.lanes, d, before + 3 * kScanLines);
    hn::StoreU(iy.lanes, d, before + 4 * kScanLines);
    if (pixel == size) {
      return;
    }
    const Real z = hn::PromoteTo(d, hn::LoadU(single, depth + pixel * kScanLines + line));
    const Real inverse = Real(1.0) / z;
    hn::StoreU(inverse.lanes, d, inverse_depth + pixel * kScanLines + line);
    const Condition measured = hn::Eq(inverse.lanes, inverse.lanes);
    const auto at = static_cast<double>(pixel);
    n += onlyWhere(measured, 1.0);
    i += onlyWhere(measured, at);
    ii += onlyWhere(measured, at * at);
    y += onlyWhere(measured, inverse);
    iy += onlyWhere(measured, at * inverse);
  }
}

/// Whether a surface ends at a pixel: whether the pixels after it (in a direction, 1 or -1) are nearer than the line of
/// the stretch before it, or missing. A bit for each lane; not set where the stretch has too few measured pixels.
HWY_ATTR unsigned leavesSurface(const double* inverse_depth, int pixel, int direction, Real at, Real slope,
                                Condition enough)
{
  const LineLanes d;
  const auto inverseDepth = [&](int i) HWY_ATTR { return loadLines(inverse_depth + i * int{kScanLines}); };
  const auto onLine = [&](int i) HWY_ATTR { return at + slope * static_cast<double>(i); };
  const Real distance = magnitude(inverseDepth(pixel) - onLine(pixel));
  Condition leaves = hn::And(enough, hn::Le(distance.lanes, hn::Set(d, kSurfaceTolerance)));
  constexpr int kAhead = 3;
  for (int k = 1; k <= kAhead && !hn::AllFalse(d, leaves); ++k) {
    const int ahead = pixel + direction * k;
    // Farther ahead the line is less certain. A pixel that was not measured is not on it.
    const Real farthest = onLine(ahead) + kSurfaceTolerance * (0.5 + 0.25 * k);
    leaves = hn::AndNot(hn::Le(inverseDepth(ahead).lanes, farthest.lanes), leaves);
  }
  if (hn::AllFalse(d, leaves)) {
    return 0;
  }
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, leaves, bits);
  return bits[0];
}

HWY_ATTR void findSurfaceEnds(const float* depth, std::size_t size, double* inverse_depth, double* sums,
                              std::uint8_t* last, std::uint8_t* first)
{
  const LineLanes d;
  std::fill_n(last, size, std::uint8_t{0});
  std::fill_n(first, size, std::uint8_t{0});
  for (std::size_t line = 0; line < kScanLines; line += hn::Lanes(d)) {
    sumScanLines(depth, size, line, inverse_depth, sums);
    for (std::size_t begin = 1; begin + kStretch < size; ++begin) {
      const double* before = sums + begin * kLineSums * kScanLines + line;
      const auto sum = [&](std::size_t m) HWY_ATTR {
        const double* end = before + kStretch * kLineSums * kScanLines;
        return loadLines(end + m * kScanLines) - loadLines(before + m * kScanLines);
      };
      const Real n = sum(0);
      const Condition enough = hn::Ge(n.lanes, hn::Set(d, kFewestMeasured));
      if (hn::AllFalse(d, enough)) {
        continue;
      }
      const Real i = sum(1), ii = sum(2), y = sum(3), iy = sum(4);
      const Real slope = (iy * n - i * y) / (ii * n - i * i);
      const Real at = (y - slope * i) / n;
      const std::size_t end = begin + kStretch - 1;
      if (end + kStretch < size) {
        last[end] |= leavesSurface(inverse_depth + line, static_cast<int>(end), 1, at, slope, enough) << line;
      }
      if (begin >= kStretch) {
        first[begin] |= leavesSurface(inverse_depth + line, static_cast<int>(begin), -1, at, slope, enough) << line;
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(findSurfaceEnds);

void findSurfaceEnds(const float* depth, std::size_t size, double* inverse_depth, double* sums, std::uint8_t* last,
                     std::uint8_t* first)
{
  HWY_DYNAMIC_DISPATCH(findSurfaceEnds)(depth, size, inverse_depth, sums, last, first);
}

}  // namespace grasp_affordances
#endif
