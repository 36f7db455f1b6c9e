#include "core/kernels/measured_kernels.h"

#include <cmath>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/measured_kernels.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_compaction.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 16>;
using U = hn::Rebind<std::uint32_t, F>;
using I = hn::Rebind<std::int32_t, F>;

constexpr float kLargest = std::numeric_limits<float>::max();

// Where the instruction set has lanes of one number only, there are no blocks of four.
#if defined(GRASP_AFFORDANCES_HIGHWAY) && HWY_TARGET != HWY_SCALAR
/// Splits points, four at a time. Reads four numbers of each point; the last is not used. @return how many points
HWY_ATTR HWY_INLINE std::size_t splitBlocks(const std::uint8_t* points, std::size_t step, std::size_t count, float* x,
                                            float* y, float* z)
{
  constexpr std::size_t kBlock = 4;
  const hn::FixedTag<float, kBlock> f;
  const hn::Repartition<std::uint8_t, decltype(f)> bytes;
  const auto load = [&](std::size_t i) HWY_ATTR { return hn::BitCast(f, hn::LoadU(bytes, points + i * step)); };
  std::size_t i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    const auto p0 = load(i), p1 = load(i + 1), p2 = load(i + 2), p3 = load(i + 3);
    const auto xy02 = hn::InterleaveLower(p0, p2), xy13 = hn::InterleaveLower(p1, p3);
    const auto z02 = hn::InterleaveUpper(f, p0, p2), z13 = hn::InterleaveUpper(f, p1, p3);
    hn::StoreU(hn::InterleaveLower(xy02, xy13), f, x + i);
    hn::StoreU(hn::InterleaveUpper(f, xy02, xy13), f, y + i);
    hn::StoreU(hn::InterleaveLower(z02, z13), f, z + i);
  }
  return i;
}
#else
std::size_t splitBlocks(const std::uint8_t*, std::size_t, std::size_t, float*, float*, float*)
{
  return 0;
}
#endif

HWY_ATTR void splitPoints(const std::uint8_t* points, std::size_t step, std::size_t count, float* x, float* y, float* z)
{
  // A fourth number can be read behind each point but the last.
  std::size_t i = count == 0 ? 0 : splitBlocks(points, step, count - 1, x, y, z);
  for (; i < count; ++i) {
    float point[3];
    std::memcpy(point, points + i * step, sizeof(point));
    x[i] = point[0];
    y[i] = point[1];
    z[i] = point[2];
  }
}

HWY_ATTR void blankUnmeasured(float* x, float* y, float* z, std::size_t count)
{
  const F f;
  const float nan = std::nanf("");
  const auto nans = hn::Set(f, nan), largest = hn::Set(f, kLargest), zero = hn::Zero(f);
  std::size_t i = 0;
  for (; i + hn::Lanes(f) <= count; i += hn::Lanes(f)) {
    const auto px = hn::LoadU(f, x + i), py = hn::LoadU(f, y + i), pz = hn::LoadU(f, z + i);
    const auto squared = hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz));
    const auto measured = hn::And(hn::Gt(squared, zero), hn::Le(squared, largest));
    hn::StoreU(hn::IfThenElse(measured, px, nans), f, x + i);
    hn::StoreU(hn::IfThenElse(measured, py, nans), f, y + i);
    hn::StoreU(hn::IfThenElse(measured, pz, nans), f, z + i);
  }
  for (; i < count; ++i) {
    const float squared = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    if (!(squared > 0.0F && squared <= kLargest)) {
      x[i] = y[i] = z[i] = nan;
    }
  }
}

HWY_ATTR std::size_t countMeasured(const float* x, std::size_t count)
{
  const F f;
  std::size_t found = 0;
  std::size_t i = 0;
  for (; i + hn::Lanes(f) <= count; i += hn::Lanes(f)) {
    const auto px = hn::LoadU(f, x + i);
    found += hn::CountTrue(f, hn::Eq(px, px));
  }
  for (; i < count; ++i) {
    found += x[i] == x[i] ? 1 : 0;
  }
  return found;
}

HWY_ATTR void listMeasured(const float* x, std::size_t count, std::uint32_t* list, std::size_t room)
{
  const F f;
  const U u;
  std::size_t listed = 0;
  std::size_t i = 0;
  for (; i + hn::Lanes(f) <= count && listed + hn::Lanes(f) <= room; i += hn::Lanes(f)) {
    const auto px = hn::LoadU(f, x + i);
    const Compaction<F> measured(hn::Eq(px, px));
    hn::StoreU(measured(hn::Add(hn::Set(u, static_cast<std::uint32_t>(i)), hn::Iota(u, 0))), u, list + listed);
    listed += measured.count;
  }
  for (; i < count && listed < room; ++i) {
    if (x[i] == x[i]) {
      list[listed++] = static_cast<std::uint32_t>(i);
    }
  }
}

HWY_ATTR std::size_t gatherMeasured(const float* const from[3], const std::uint32_t* index, std::size_t count,
                                    float* const to[3])
{
  const F f;
  const U u;
  const I signed_index;
  std::size_t copied = 0;
  std::size_t i = 0;
  for (; i + hn::Lanes(f) <= count; i += hn::Lanes(f)) {
    const auto at = hn::BitCast(signed_index, hn::LoadU(u, index + i));
    const auto x = hn::GatherIndex(f, from[0], at);
    const Compaction<F> measured(hn::Eq(x, x));
    if (measured.count == 0) {
      continue;
    }
    hn::StoreU(measured(x), f, to[0] + copied);
    hn::StoreU(measured(hn::GatherIndex(f, from[1], at)), f, to[1] + copied);
    hn::StoreU(measured(hn::GatherIndex(f, from[2], at)), f, to[2] + copied);
    copied += measured.count;
  }
  for (; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      to[axis][copied] = from[axis][index[i]];
    }
    copied += to[0][copied] == to[0][copied] ? 1 : 0;
  }
  return copied;
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(splitPoints);
HWY_EXPORT(blankUnmeasured);
HWY_EXPORT(countMeasured);
HWY_EXPORT(listMeasured);
HWY_EXPORT(gatherMeasured);

void splitPoints(const std::uint8_t* points, std::size_t step, std::size_t count, float* x, float* y, float* z)
{
  HWY_DYNAMIC_DISPATCH(splitPoints)(points, step, count, x, y, z);
}

void blankUnmeasured(float* x, float* y, float* z, std::size_t count)
{
  HWY_DYNAMIC_DISPATCH(blankUnmeasured)(x, y, z, count);
}

std::size_t countMeasured(const float* x, std::size_t count)
{
  return HWY_DYNAMIC_DISPATCH(countMeasured)(x, count);
}

void listMeasured(const float* x, std::size_t count, std::uint32_t* list, std::size_t room)
{
  HWY_DYNAMIC_DISPATCH(listMeasured)(x, count, list, room);
}

std::size_t gatherMeasured(const float* const from[3], const std::uint32_t* index, std::size_t count,
                           float* const to[3])
{
  return HWY_DYNAMIC_DISPATCH(gatherMeasured)(from, index, count, to);
}

}  // namespace grasp_affordances
#endif
