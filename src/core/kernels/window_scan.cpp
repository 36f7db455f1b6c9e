#include "core/kernels/window_scan.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/window_scan.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_compaction.h"
#include "core/kernels/simd_rows.h"

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
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// As grasp_affordances::squaredLength.
template <class V>
HWY_ATTR HWY_INLINE V squaredLength(V x, V y, V z)
{
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

enum class Keeping
{
  nothing,
  points,
  points_and_indices,
  unsurveyed  // points and indices; nothing else is asked for
};

/// Goes through the points of a window, and keeps those within a sphere.
template <Keeping Keep>
struct SphereScan
{
  template <class Tag>
  HWY_ATTR HWY_INLINE void operator()(Tag f, std::size_t i, hn::Mask<Tag> counts)
  {
    const auto px = hn::LoadU(f, x + i), py = hn::LoadU(f, y + i), pz = hn::LoadU(f, z + i);
    const auto squared =
        squaredLength(hn::Sub(px, hn::Set(f, cx)), hn::Sub(py, hn::Set(f, cy)), hn::Sub(pz, hn::Set(f, cz)));
    // False for NaN: a point that was not measured is in no sphere, and not the closest one.
    const auto inside = hn::And(counts, hn::Le(squared, hn::Set(f, squared_radius)));
    if constexpr (Keep != Keeping::unsurveyed) {
      const auto range = squaredLength(px, py, pz), infinity = hn::Set(f, kInfinity);
      const auto range_inside = hn::IfThenElse(inside, range, infinity);
      keepSmallest(f, range_inside, closest, rest_closest);
      if constexpr (Keep != Keeping::nothing) {
        const auto range_in_window = hn::IfThenElse(hn::And(counts, hn::Lt(range, infinity)), range, infinity);
        keepSmallest(f, range_in_window, closest_in_window, rest_closest_in_window);
      }
    }
    if constexpr (Keep != Keeping::nothing) {
      const Compaction<Tag> kept(inside);
      if (hn::MaxLanes(f) == 1 || kept.count > 0) {  // of one lane nobody can tell in advance: it is written anyway
        hn::StoreU(kept(px), f, to.x + points);
        hn::StoreU(kept(py), f, to.y + points);
        hn::StoreU(kept(pz), f, to.z + points);
        if constexpr (Keep != Keeping::points) {
          const hn::Rebind<std::uint32_t, Tag> u;
          hn::StoreU(kept(hn::Add(hn::Set(u, static_cast<std::uint32_t>(i)), hn::Iota(u, 0))), u, to.index + points);
        }
      }
      points += kept.count;
    } else {
      points += hn::CountTrue(f, inside);
    }
  }

  template <class Tag>
  HWY_ATTR HWY_INLINE static void keepSmallest(Tag, hn::Vec<Tag> values, Floats& smallest, float& rest)
  {
    if constexpr (std::is_same_v<Tag, F>) {
      smallest = hn::Min(smallest, values);
    } else {
      rest = std::min(rest, hn::GetLane(values));
    }
  }

  const float *x, *y, *z;
  float cx, cy, cz, squared_radius;
  GatheredPoints to;
  std::size_t points = 0;
  Floats closest = hn::Set(F(), kInfinity), closest_in_window = hn::Set(F(), kInfinity);
  float rest_closest = kInfinity, rest_closest_in_window = kInfinity;
};

template <Keeping Keep>
HWY_ATTR HWY_INLINE SphereSurvey scanSphere(const PixelRows& window, const float center[3], float squared_radius,
                                            const GatheredPoints& to)
{
  SphereScan<Keep> scan{window.x, window.y, window.z, center[0], center[1], center[2], squared_radius, to};
  for (std::size_t row = 0; row < window.rows; ++row) {
    const std::size_t begin = window.first + row * window.stride;
    scanRow(begin, begin + window.columns, window.points, scan);
  }
  const auto smallest = [](Floats values, float rest)
                            HWY_ATTR { return std::min(rest, hn::GetLane(hn::MinOfLanes(F(), values))); };
  if constexpr (Keep == Keeping::unsurveyed) {
    return {scan.points, 0.0F, 0.0F};
  }
  return {scan.points, smallest(scan.closest, scan.rest_closest),
          Keep != Keeping::nothing ? smallest(scan.closest_in_window, scan.rest_closest_in_window) : 0.0F};
}

HWY_ATTR SphereSurvey surveySphere(const PixelRows& window, const float center[3], float squared_radius)
{
  return scanSphere<Keeping::nothing>(window, center, squared_radius, {});
}

HWY_ATTR SphereSurvey gatherSphere(const PixelRows& window, const float center[3], float squared_radius,
                                   const GatheredPoints& gathered)
{
  return gathered.index != nullptr ? scanSphere<Keeping::points_and_indices>(window, center, squared_radius, gathered)
                                   : scanSphere<Keeping::points>(window, center, squared_radius, gathered);
}

HWY_ATTR std::size_t gatherUnsurveyed(const PixelRows& window, const float center[3], float squared_radius,
                                      const GatheredPoints& gathered)
{
  return scanSphere<Keeping::unsurveyed>(window, center, squared_radius, gathered).points;
}

HWY_ATTR float closestSquaredRange(const float* x, const float* y, const float* z, std::size_t count)
{
  const F f;
  Floats closest = hn::Set(f, kInfinity);
  float rest = kInfinity;
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
  constexpr float kAnywhere = -kInfinity;
  const float least_along = cone.tangent > 0.0F ? 0.0F : kAnywhere;
  std::size_t count = 0;
  for (std::size_t row = window.rows; row > 0 && count <= enough; --row) {
    const std::size_t begin = window.first + (row - 1) * window.stride;
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
HWY_EXPORT(gatherUnsurveyed);
HWY_EXPORT(surveySphere);
HWY_EXPORT(closestSquaredRange);
HWY_EXPORT(countNearer);

SphereSurvey gatherSphere(const PixelRows& window, const float center[3], float squared_radius,
                          const GatheredPoints& gathered)
{
  return HWY_DYNAMIC_DISPATCH(gatherSphere)(window, center, squared_radius, gathered);
}

std::size_t gatherUnsurveyed(const PixelRows& window, const float center[3], float squared_radius,
                             const GatheredPoints& gathered)
{
  return HWY_DYNAMIC_DISPATCH(gatherUnsurveyed)(window, center, squared_radius, gathered);
}

SphereSurvey surveySphere(const PixelRows& window, const float center[3], float squared_radius)
{
  return HWY_DYNAMIC_DISPATCH(surveySphere)(window, center, squared_radius);
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
