#include "core/kernels/nearest.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/nearest.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_compaction.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kGatherSlack>;
using U = hn::Rebind<std::uint32_t, F>;

// Floats that are not negative have the same order as their bits.
inline std::int32_t bitsOf(float value)
{
  std::int32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

inline float floatOf(std::int32_t bits)
{
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

/// Writes the squared distances from the centre, and NaN, which is no distance, up to the end of a register.
HWY_ATTR HWY_INLINE void squareDistances(const GatheredPoints& points, std::size_t count, const float center[3],
                                         float* squared)
{
  const F f;
  const auto cx = hn::Set(f, center[0]), cy = hn::Set(f, center[1]), cz = hn::Set(f, center[2]);
  std::size_t i = 0;
  for (; i + hn::Lanes(f) <= count; i += hn::Lanes(f)) {
    const auto dx = hn::Sub(hn::LoadU(f, points.x + i), cx);
    const auto dy = hn::Sub(hn::LoadU(f, points.y + i), cy);
    const auto dz = hn::Sub(hn::LoadU(f, points.z + i), cz);
    hn::StoreU(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)), f, squared + i);
  }
  for (; i < count; ++i) {
    const float dx = points.x[i] - center[0], dy = points.y[i] - center[1], dz = points.z[i] - center[2];
    squared[i] = dx * dx + dy * dy + dz * dz;
  }
  std::fill_n(squared + count, kGatherSlack, std::numeric_limits<float>::quiet_NaN());
}

HWY_ATTR HWY_INLINE std::size_t countUpTo(float limit, const float* squared, std::size_t count)
{
  const F f;
  const auto limits = hn::Set(f, limit);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(f)) {
    found += hn::CountTrue(f, hn::Le(hn::LoadU(f, squared + i), limits));
  }
  return found;
}

/// The largest of the numbers that are not above the limit.
HWY_ATTR HWY_INLINE float largestUpTo(float limit, const float* squared, std::size_t count)
{
  const F f;
  const auto limits = hn::Set(f, limit);
  auto largest = hn::Zero(f);
  for (std::size_t i = 0; i < count; i += hn::Lanes(f)) {
    const auto value = hn::LoadU(f, squared + i);
    largest = hn::Max(largest, hn::IfThenElseZero(hn::Le(value, limits), value));
  }
  float lanes[kGatherSlack];
  hn::StoreU(largest, f, lanes);
  return *std::max_element(lanes, lanes + hn::Lanes(f));
}

struct Selection
{
  float value;        // the k-th smallest
  std::size_t below;  // how many are smaller, where `tied`
  bool tied;          // more than k numbers are not above the value
};

/// Finds the k-th smallest number by narrowing an interval down. The squared distances of a surface's points are spread
/// evenly, and interpolation takes a few steps. Elsewhere halving bounds the number of steps.
HWY_ATTR HWY_INLINE Selection select(std::size_t k, const float* squared, std::size_t count)
{
  std::int32_t low = -1;  // fewer than k are up to here
  std::int32_t high = bitsOf(largestUpTo(std::numeric_limits<float>::infinity(), squared, count));  // at least k are
  std::size_t up_to_low = 0, up_to_high = count;
  constexpr int kInterpolations = 8;
  for (int step = 0; up_to_high != k && high - low > 1; ++step) {
    std::int32_t middle = low + (high - low) / 2;
    if (step < kInterpolations) {
      const double first = floatOf(std::max(low, 0)), last = floatOf(high);
      const double share = (static_cast<double>(k - up_to_low) - 0.5) / static_cast<double>(up_to_high - up_to_low);
      const double guess = first + share * (last - first);
      middle = guess < last ? std::clamp(bitsOf(static_cast<float>(guess)), low + 1, high - 1) : middle;
    }
    const std::size_t up_to_middle = countUpTo(floatOf(middle), squared, count);
    (up_to_middle < k ? low : high) = middle;
    (up_to_middle < k ? up_to_low : up_to_high) = up_to_middle;
  }
  if (up_to_high == k) {
    return {largestUpTo(floatOf(high), squared, count), 0, false};
  }
  return {floatOf(high), up_to_low, true};
}

/// Moves those of the points [begin, end) whose squared distance is not above the limit to the places from `kept` on;
/// `kept` is at most `begin`. @return where they end
HWY_ATTR HWY_INLINE std::size_t moveUpTo(float limit, const GatheredPoints& points, const float* squared,
                                         std::size_t begin, std::size_t end, std::size_t kept)
{
  const F f;
  const U u;
  const auto limits = hn::Set(f, limit);
  std::size_t i = begin;
  for (; i + hn::Lanes(f) <= end; i += hn::Lanes(f)) {
    const Compaction<F> near(hn::Le(hn::LoadU(f, squared + i), limits));
    hn::StoreU(near(hn::LoadU(f, points.x + i)), f, points.x + kept);
    hn::StoreU(near(hn::LoadU(f, points.y + i)), f, points.y + kept);
    hn::StoreU(near(hn::LoadU(f, points.z + i)), f, points.z + kept);
    hn::StoreU(near(hn::LoadU(u, points.index + i)), u, points.index + kept);
    kept += near.count;
  }
  for (; i < end; ++i) {
    points.x[kept] = points.x[i];
    points.y[kept] = points.y[i];
    points.z[kept] = points.z[i];
    points.index[kept] = points.index[i];
    kept += squared[i] <= limit ? 1 : 0;
  }
  return kept;
}

HWY_ATTR float keepNearest(const GatheredPoints& points, std::size_t count, const float center[3], std::size_t k,
                           float* squared)
{
  squareDistances(points, count, center, squared);
  const Selection last = select(k, squared, count);
  if (!last.tied) {
    moveUpTo(last.value, points, squared, 0, count, 0);
    return last.value;
  }
  std::size_t end = 0;  // where the moved points end, before those that are left out for their order
  for (std::size_t wanted = k - last.below; wanted > 0; ++end) {
    wanted -= squared[end] == last.value ? 1 : 0;
  }
  const std::size_t kept = moveUpTo(last.value, points, squared, 0, end, 0);
  const float below = last.value > 0.0F ? floatOf(bitsOf(last.value) - 1) : -1.0F;
  moveUpTo(below, points, squared, end, count, kept);
  return last.value;
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(keepNearest);

float keepNearest(const GatheredPoints& points, std::size_t count, const float center[3], std::size_t k, float* squared)
{
  return HWY_DYNAMIC_DISPATCH(keepNearest)(points, count, center, k, squared);
}

}  // namespace grasp_affordances
#endif
