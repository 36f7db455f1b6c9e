#include "core/window_scan.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/window_scan.cpp"
#include "core/simd.h"
#include "core/simd_compaction.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::CappedTag<float, kGatherSlack>;
using U = hn::Rebind<std::uint32_t, F>;
using Floats = hn::Vec<F>;
using Floats1 = hn::CappedTag<float, 1>;

/// As grasp_affordances::squaredLength.
template <class V>
HWY_ATTR HWY_INLINE V squaredLength(V x, V y, V z)
{
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

/// Calls scan(tag, index of the first point, mask of the points that count) for all points of a row, as many at a time
/// as there are lanes; at the end of the arrays one at a time.
template <class Scan>
HWY_ATTR HWY_INLINE void scanRow(std::size_t begin, std::size_t end, std::size_t points, Scan&& scan)
{
  const F f;
  std::size_t i = begin;
  for (; i + hn::Lanes(f) <= end; i += hn::Lanes(f)) {
    scan(f, i, hn::FirstN(f, hn::Lanes(f)));
  }
  if (i < end && i + hn::Lanes(f) <= points) {
    scan(f, i, hn::FirstN(f, end - i));
    return;
  }
  const Floats1 single;
  for (; i < end; ++i) {
    scan(single, i, hn::FirstN(single, 1));
  }
}

/// Appends the points of a sphere to what was gathered before.
struct SphereGatherer
{
  GatheredPoints to;
  const float *x, *y, *z;
  float cx, cy, cz, squared_radius;
  std::size_t count = 0;

  template <class Tag>
  HWY_ATTR HWY_INLINE void operator()(Tag f, std::size_t i, hn::Mask<Tag> counts)
  {
    const auto px = hn::LoadU(f, x + i), py = hn::LoadU(f, y + i), pz = hn::LoadU(f, z + i);
    const auto squared =
        squaredLength(hn::Sub(px, hn::Set(f, cx)), hn::Sub(py, hn::Set(f, cy)), hn::Sub(pz, hn::Set(f, cz)));
    // False for NaN: what was not measured is in no sphere.
    const Compaction<Tag> inside(hn::And(counts, hn::Le(squared, hn::Set(f, squared_radius))));
    if (inside.count == 0) {
      return;
    }
    const hn::Rebind<std::uint32_t, Tag> u;
    hn::StoreU(inside(px), f, to.x + count);
    hn::StoreU(inside(py), f, to.y + count);
    hn::StoreU(inside(pz), f, to.z + count);
    hn::StoreU(inside(hn::Add(hn::Set(u, static_cast<std::uint32_t>(i)), hn::Iota(u, 0))), u, to.index + count);
    count += inside.count;
  }
};

HWY_ATTR std::size_t gatherSphere(const PixelRows& window, const float center[3], float squared_radius,
                                  const GatheredPoints& gathered)
{
  SphereGatherer gatherer{gathered, window.x, window.y, window.z, center[0], center[1], center[2], squared_radius};
  for (std::size_t row = 0; row < window.rows; ++row) {
    const std::size_t begin = window.first + row * window.stride;
    scanRow(begin, begin + window.columns, window.points, gatherer);
  }
  return gatherer.count;
}

HWY_ATTR float closestSquaredRange(const float* x, const float* y, const float* z, std::size_t count)
{
  const F f;
  Floats closest = hn::Set(f, std::numeric_limits<float>::infinity());
  float rest = std::numeric_limits<float>::infinity();
  scanRow(0, count, count, [&](auto tag, std::size_t i, auto) HWY_ATTR {
    const auto range = squaredLength(hn::LoadU(tag, x + i), hn::LoadU(tag, y + i), hn::LoadU(tag, z + i));
    if constexpr (std::is_same_v<decltype(tag), F>) {
      closest = hn::Min(range, closest);
    } else {
      rest = std::min(rest, hn::GetLane(range));
    }
  });
  return std::min(rest, hn::GetLane(hn::MinOfLanes(f, closest)));
}

HWY_ATTR std::size_t countNearer(const PixelRows& window, const ViewCone& cone, float squared_range, std::size_t enough)
{
  constexpr float kAnywhere = -std::numeric_limits<float>::infinity();
  const float least_along = cone.tangent > 0.0F ? 0.0F : kAnywhere;
  std::size_t count = 0;
  for (std::size_t row = 0; row < window.rows && count <= enough; ++row) {
    const std::size_t begin = window.first + row * window.stride;
    scanRow(begin, begin + window.columns, window.points, [&](auto f, std::size_t i, auto counts) HWY_ATTR {
      const auto x = hn::LoadU(f, window.x + i), y = hn::LoadU(f, window.y + i), z = hn::LoadU(f, window.z + i);
      const auto range = squaredLength(x, y, z);
      // False for NaN.
      const auto nearer = hn::And(counts, hn::Lt(range, hn::Set(f, squared_range)));
      if (hn::AllFalse(f, nearer)) {
        return;
      }
      const auto along =
          hn::Add(hn::Add(hn::Mul(x, hn::Set(f, cone.center[0])), hn::Mul(y, hn::Set(f, cone.center[1]))),
                  hn::Mul(z, hn::Set(f, cone.center[2])));
      const auto ahead = hn::Ge(along, hn::Set(f, least_along));
      const auto within = hn::Ge(hn::Mul(along, along), hn::Mul(hn::Set(f, cone.tangent), range));
      count += hn::CountTrue(f, hn::And(nearer, hn::And(ahead, within)));
    });
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(gatherSphere);
HWY_EXPORT(closestSquaredRange);
HWY_EXPORT(countNearer);

std::size_t gatherSphere(const PixelRows& window, const float center[3], float squared_radius,
                         const GatheredPoints& gathered)
{
  return HWY_DYNAMIC_DISPATCH(gatherSphere)(window, center, squared_radius, gathered);
}

float closestSquaredRange(const float* x, const float* y, const float* z, std::size_t count)
{
  return HWY_DYNAMIC_DISPATCH(closestSquaredRange)(x, y, z, count);
}

std::size_t countNearer(const PixelRows& window, const ViewCone& cone, float squared_range, std::size_t enough)
{
  return HWY_DYNAMIC_DISPATCH(countNearer)(window, cone, squared_range, enough);
}

}  // namespace grasp_affordances
#endif
