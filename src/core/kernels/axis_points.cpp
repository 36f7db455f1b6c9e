#include "core/kernels/axis_points.h"

#include <algorithm>
#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/axis_points.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_compaction.h"
#include "core/kernels/simd_real.h"
#include "core/kernels/simd_rows.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;
static_assert(kAxisPointGroup == kRealLanes, "groups of points fill lanes of double precision");

template <class V>
HWY_ATTR HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz)
{
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

template <class Tag>
HWY_ATTR HWY_INLINE hn::Mask<Tag> within(Tag f, hn::Vec<Tag> value, float low, float high)
{
  return hn::And(hn::Le(hn::Set(f, low), value), hn::Le(value, hn::Set(f, high)));
}

struct CylinderChooser
{
  const float *x, *y, *z;
  CylinderBounds bounds;
  ChosenPoints to;
  std::size_t count = 0;

  template <class Tag>
  HWY_ATTR HWY_INLINE void operator()(Tag f, std::size_t i, hn::Mask<Tag> counts)
  {
    const auto pz = hn::LoadU(f, z + i);
    const auto near = hn::And(counts, within(f, pz, bounds.nearest, bounds.farthest));
    if (hn::AllFalse(f, near)) {
      return;
    }
    const auto px = hn::LoadU(f, x + i), py = hn::LoadU(f, y + i);
    const auto qx = hn::Sub(px, hn::Set(f, bounds.origin[0])), qy = hn::Sub(py, hn::Set(f, bounds.origin[1])),
               qz = hn::Sub(pz, hn::Set(f, bounds.origin[2]));
    const auto along =
        dot(qx, qy, qz, hn::Set(f, bounds.axis[0]), hn::Set(f, bounds.axis[1]), hn::Set(f, bounds.axis[2]));
    const auto squared_radius = hn::Sub(dot(qx, qy, qz, qx, qy, qz), hn::Mul(along, along));
    const Compaction<Tag> chosen(hn::And(hn::And(near, within(f, along, bounds.begin, bounds.end)),
                                         hn::Le(squared_radius, hn::Set(f, bounds.squared_radius))));
    if (chosen.count == 0) {
      return;
    }
    hn::StoreU(chosen(px), f, to.x + count);
    hn::StoreU(chosen(py), f, to.y + count);
    hn::StoreU(chosen(pz), f, to.z + count);
    hn::StoreU(chosen(along), f, to.along + count);
    count += chosen.count;
  }
};

HWY_ATTR std::size_t chooseInCylinder(const float* const points[3], std::size_t size, const PixelSpan* spans,
                                      std::size_t span_count, const CylinderBounds& bounds, const ChosenPoints& chosen)
{
  CylinderChooser chooser{points[0], points[1], points[2], bounds, chosen};
  for (std::size_t i = 0; i < span_count; ++i) {
    scanRow(spans[i].begin, spans[i].end, size, chooser);
  }
  return chooser.count;
}

struct SliceDealer
{
  ChosenPoints from;
  SliceRow slices;
  float* const* dealt;
  std::size_t room;
  std::size_t* sizes;

  template <class Tag>
  HWY_ATTR HWY_INLINE void deal(Tag f, std::size_t i, hn::Mask<Tag> counts, std::size_t slice) const
  {
    const Compaction<Tag> chosen(counts);
    const std::size_t size = sizes[slice], place = slice * room + size;
    if (size + kChoiceSlack <= room) {
      hn::StoreU(chosen(hn::LoadU(f, from.x + i)), f, dealt[0] + place);
      hn::StoreU(chosen(hn::LoadU(f, from.y + i)), f, dealt[1] + place);
      hn::StoreU(chosen(hn::LoadU(f, from.z + i)), f, dealt[2] + place);
    }
    sizes[slice] = size + chosen.count;
  }

  template <class Tag>
  HWY_ATTR HWY_INLINE void operator()(Tag f, std::size_t i, hn::Mask<Tag> counts) const
  {
    const float last = static_cast<float>(slices.count - 1), edge = slices.rounding / slices.thickness;
    const auto place =
        hn::Mul(hn::Sub(hn::LoadU(f, from.along + i), hn::Set(f, slices.begin)), hn::Set(f, 1.0F / slices.thickness));
    const auto number = hn::Min(hn::Max(hn::Floor(place), hn::Zero(f)), hn::Set(f, last));
    const auto within = hn::Sub(place, number);
    const auto at_begin = hn::Le(within, hn::Set(f, edge)), at_end = hn::Ge(within, hn::Set(f, 1.0F - edge));
    const bool borders = !hn::AllFalse(f, hn::And(counts, hn::Or(at_begin, at_end)));
    const auto lowest = hn::MinOfLanes(f, hn::IfThenElse(counts, number, hn::Set(f, last)));
    const auto highest = hn::MaxOfLanes(f, hn::IfThenElse(counts, number, hn::Zero(f)));
    const float wider = borders ? 1.0F : 0.0F;
    const auto first_slice = static_cast<std::size_t>(std::max(hn::GetLane(lowest) - wider, 0.0F));
    const auto last_slice = static_cast<std::size_t>(std::min(hn::GetLane(highest) + wider, last));
    for (std::size_t slice = first_slice; slice <= last_slice; ++slice) {
      const auto here = static_cast<float>(slice);
      auto in_slice = hn::Eq(number, hn::Set(f, here));
      if (borders) {
        const auto before = hn::And(at_end, hn::Eq(number, hn::Set(f, here - 1.0F)));
        const auto after = hn::And(at_begin, hn::Eq(number, hn::Set(f, here + 1.0F)));
        in_slice = hn::Or(in_slice, hn::Or(before, after));
      }
      deal(f, i, hn::And(counts, in_slice), slice);
    }
  }
};

HWY_ATTR void dealToSlices(const ChosenPoints& chosen, std::size_t count, const SliceRow& slices, float* const dealt[3],
                           std::size_t room, std::size_t* sizes)
{
  std::fill(sizes, sizes + slices.count, 0);
  scanRow(0, count, count + kChoiceSlack, SliceDealer{chosen, slices, dealt, room, sizes});
}

HWY_ATTR HWY_INLINE Real offset(const float* coordinate, double origin)
{
  const Real::D d;
  const hn::Rebind<float, Real::D> single;
  return Real(hn::PromoteTo(d, hn::LoadU(single, coordinate))) - Real(origin);
}

HWY_ATTR HWY_INLINE Real component(Real x, Real y, Real z, const double direction[3])
{
  return x * Real(direction[0]) + y * Real(direction[1]) + z * Real(direction[2]);
}

HWY_ATTR std::size_t takeSlice(const float* const points[3], std::size_t count, const AxisFrame& frame, double begin,
                               double end, const AxisPointArrays& taken)
{
  const Real::D d;
  const Real out_of_reach(1e9);
  const std::size_t size = (count + kAxisPointGroup - 1) / kAxisPointGroup * kAxisPointGroup;
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const Real x = offset(points[0] + i, frame.origin[0]), y = offset(points[1] + i, frame.origin[1]),
               z = offset(points[2] + i, frame.origin[2]);
    const Real along = component(x, y, z, frame.axis);
    const Condition in_slice =
        hn::And(hn::FirstN(d, i < count ? count - i : 0),
                hn::And(hn::Le(Real(begin).lanes, along.lanes), hn::Lt(along.lanes, Real(end).lanes)));
    hn::StoreU(along.lanes, d, taken.along + i);
    hn::StoreU(choose(in_slice, component(x, y, z, frame.first), out_of_reach).lanes, d, taken.first + i);
    hn::StoreU(component(x, y, z, frame.second).lanes, d, taken.second + i);
  }
  return size;
}

/// Points of a shell, as many as there are lanes.
struct ShellPoints
{
  Real along, x, y, squared_radius;

  HWY_ATTR HWY_INLINE ShellPoints(const AxisPoints& points, const ShellBounds& shell, std::size_t i)
      : along(hn::LoadU(Real::D(), points.along + i)),
        x(hn::LoadU(Real::D(), points.first + i)),
        y(hn::LoadU(Real::D(), points.second + i))
  {
    const Real dx = x - Real(shell.center[0]), dy = y - Real(shell.center[1]);
    squared_radius = dx * dx + dy * dy;
  }

  HWY_ATTR HWY_INLINE Condition between(const ShellBounds& shell) const
  {
    return hn::And(hn::Le(Real(shell.begin).lanes, along.lanes), hn::Le(along.lanes, Real(shell.end).lanes));
  }
  HWY_ATTR HWY_INLINE Condition upTo(double squared) const { return hn::Le(squared_radius.lanes, Real(squared).lanes); }
};

#ifdef GRASP_AFFORDANCES_HIGHWAY
HWY_ATTR ShellCounts countPoints(const AxisPoints& points, const ShellBounds& shell)
{
  const Real::D d;
  ShellCounts counts;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(d)) {
    const ShellPoints p(points, shell, i);
    const Condition between = p.between(shell);
    const auto count = [&](double squared) HWY_ATTR {
      return static_cast<std::uint32_t>(hn::CountTrue(d, hn::And(between, p.upTo(squared))));
    };
    counts.short_of_filled += count(shell.squared_filled);
    counts.inside += count(shell.squared_inner);
    counts.up_to_outer += count(shell.squared_outer);
  }
  return counts;
}
#else
/// Two at a time, in vectors of the compiler: it makes none by itself of conditions that are counted.
ShellCounts countPoints(const AxisPoints& points, const ShellBounds& shell)
{
  using Numbers = double __attribute__((vector_size(16)));
  using Counts = std::int64_t __attribute__((vector_size(16)));  // true is -1
  static_assert(kAxisPointGroup % 2 == 0, "groups of points fill vectors");
  const auto load = [](const double* from) { return Numbers{from[0], from[1]}; };
  const ShellBounds bounds = shell;
  Counts short_of_filled{}, inside{}, up_to_outer{};
  for (std::size_t i = 0; i < points.size; i += 2) {
    const Numbers along = load(points.along + i);
    const Numbers dx = load(points.first + i) - bounds.center[0], dy = load(points.second + i) - bounds.center[1];
    const Numbers squared_radius = dx * dx + dy * dy;
    const Counts between = (along >= bounds.begin) & (along <= bounds.end);
    short_of_filled -= between & (squared_radius <= bounds.squared_filled);
    inside -= between & (squared_radius <= bounds.squared_inner);
    up_to_outer -= between & (squared_radius <= bounds.squared_outer);
  }
  const auto sum = [](const Counts& counts) { return static_cast<std::uint32_t>(counts[0] + counts[1]); };
  ShellCounts counts;
  counts.short_of_filled = sum(short_of_filled);
  counts.inside = sum(inside);
  counts.up_to_outer = sum(up_to_outer);
  return counts;
}
#endif

HWY_ATTR AlongRange insideRange(const AxisPoints& points, const ShellBounds& shell)
{
  const Real::D d;
  const Real none(std::numeric_limits<double>::infinity());
  Real first = none, last = Real(0.0) - none;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(d)) {
    const ShellPoints p(points, shell, i);
    const Condition inside = hn::And(p.between(shell), p.upTo(shell.squared_inner));
    first = smaller(first, choose(inside, p.along, none));
    last = larger(last, choose(inside, p.along, Real(0.0) - none));
  }
  std::array<double, kRealLanes> firsts, lasts;
  hn::StoreU(first.lanes, d, firsts.data());
  hn::StoreU(last.lanes, d, lasts.data());
  return {*std::min_element(firsts.begin(), firsts.begin() + hn::Lanes(d)),
          *std::max_element(lasts.begin(), lasts.begin() + hn::Lanes(d))};
}

HWY_ATTR void addMoments(const AxisPoints& points, const ShellBounds& shell, PlaneMomentParts& sums)
{
  const Real::D d;
  for (std::size_t part = 0; part < kAxisPointGroup; part += hn::Lanes(d)) {
    Real sum[kPlaneMoments];
    for (int m = 0; m < kPlaneMoments; ++m) {
      sum[m] = Real(hn::Load(d, &sums.of[m][part]));
    }
    for (std::size_t i = part; i < points.size; i += kAxisPointGroup) {
      const ShellPoints p(points, shell, i);
      const Condition inside = hn::And(p.between(shell), p.upTo(shell.squared_inner));
      const Real x = choose(inside, p.x, Real()), y = choose(inside, p.y, Real());
      const Real xx = x * x, yy = y * y, s = xx + yy;
      const Real moments[kPlaneMoments] = {choose(inside, Real(1.0), Real()), x, y, xx, x * y, yy, s * x, s * y, s * s};
      for (int m = 0; m < kPlaneMoments; ++m) {
        sum[m] += moments[m];
      }
    }
    for (int m = 0; m < kPlaneMoments; ++m) {
      hn::Store(sum[m].lanes, d, &sums.of[m][part]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(chooseInCylinder);
HWY_EXPORT(dealToSlices);
HWY_EXPORT(takeSlice);
HWY_EXPORT(countPoints);
HWY_EXPORT(insideRange);
HWY_EXPORT(addMoments);

std::size_t chooseInCylinder(const float* const points[3], std::size_t size, const PixelSpan* spans,
                             std::size_t span_count, const CylinderBounds& bounds, const ChosenPoints& chosen)
{
  return HWY_DYNAMIC_DISPATCH(chooseInCylinder)(points, size, spans, span_count, bounds, chosen);
}

void dealToSlices(const ChosenPoints& chosen, std::size_t count, const SliceRow& slices, float* const dealt[3],
                  std::size_t room, std::size_t* sizes)
{
  HWY_DYNAMIC_DISPATCH(dealToSlices)(chosen, count, slices, dealt, room, sizes);
}

std::size_t takeSlice(const float* const points[3], std::size_t count, const AxisFrame& frame, double begin, double end,
                      const AxisPointArrays& taken)
{
  return HWY_DYNAMIC_DISPATCH(takeSlice)(points, count, frame, begin, end, taken);
}

ShellCounts countPoints(const AxisPoints& points, const ShellBounds& shell)
{
  return HWY_DYNAMIC_DISPATCH(countPoints)(points, shell);
}

AlongRange insideRange(const AxisPoints& points, const ShellBounds& shell)
{
  return HWY_DYNAMIC_DISPATCH(insideRange)(points, shell);
}

void addMoments(const AxisPoints& points, const ShellBounds& shell, PlaneMomentParts& sums)
{
  HWY_DYNAMIC_DISPATCH(addMoments)(points, shell, sums);
}

}  // namespace grasp_affordances
#endif
