#include "core/kernels/ray_sums.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/ray_sums.cpp"
#include "core/kernels/simd.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

// Each sum consists of so many parts; column u adds to the part whose number is u modulo their number.
constexpr std::size_t kParts = 8;
using D = hn::CappedTag<double, kParts>;
using F = hn::Rebind<float, D>;
using V = hn::Vec<D>;

/// The rays of neighboring pixels of a row; slopes are zero where nothing was measured.
struct Rays
{
  V slope_x, slope_y;
  hn::Mask<D> measured;
  V depth;  // 1 where nothing was measured
};

HWY_ATTR HWY_INLINE Rays rays(V x, V y, V z)
{
  const D d;
  const auto measured = hn::Eq(z, z);
  const auto inverse = hn::Div(hn::Set(d, 1.0), z);
  return {hn::IfThenElseZero(measured, hn::Mul(x, inverse)), hn::IfThenElseZero(measured, hn::Mul(y, inverse)),
          measured, hn::IfThenElse(measured, z, hn::Set(d, 1.0))};
}

/// The pixels [i, i + lanes) of the cloud, with NaN for those from `end` on.
HWY_ATTR HWY_INLINE V load(const float* coordinates, std::size_t i, std::size_t end)
{
  const D d;
  const F f;
  if (i + hn::Lanes(d) <= end) {
    return hn::PromoteTo(d, hn::LoadU(f, coordinates + i));
  }
  float lanes[kParts];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    lanes[lane] = i + lane < end ? coordinates[i + lane] : std::numeric_limits<float>::quiet_NaN();
  }
  return hn::PromoteTo(d, hn::LoadU(f, lanes));
}

HWY_ATTR HWY_INLINE double total(const double parts[kParts])
{
  return ((parts[0] + parts[4]) + (parts[2] + parts[6])) + ((parts[1] + parts[5]) + (parts[3] + parts[7]));
}

HWY_ATTR bool sumRays(const CloudRows& rows, RaySums& sums)
{
  const D d;
  constexpr int kSums = 9;
  double parts[kSums][kParts] = {};
  auto nearest = hn::Set(d, 1.0);
  for (std::size_t part = 0; part < kParts; part += hn::Lanes(d)) {
    V sum[kSums];
    for (V& s : sum) {
      s = hn::Zero(d);
    }
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
      const std::size_t first = row * rows.width, end = first + rows.width;
      const auto v = hn::Set(d, static_cast<double>(row));
      auto u = hn::Iota(d, static_cast<double>(part));
      auto row_points = hn::Zero(d), row_slope_y = hn::Zero(d);
      for (std::size_t i = first + part; i < end; i += kParts) {
        const Rays r = rays(load(rows.x, i, end), load(rows.y, i, end), load(rows.z, i, end));
        nearest = hn::Min(nearest, r.depth);
        row_points = hn::Add(row_points, hn::IfThenElseZero(r.measured, hn::Set(d, 1.0)));
        sum[1] = hn::Add(sum[1], hn::IfThenElseZero(r.measured, u));
        sum[3] = hn::Add(sum[3], r.slope_x);
        sum[4] = hn::Add(sum[4], hn::Mul(r.slope_x, r.slope_x));
        sum[5] = hn::Add(sum[5], hn::Mul(r.slope_x, u));
        row_slope_y = hn::Add(row_slope_y, r.slope_y);
        sum[7] = hn::Add(sum[7], hn::Mul(r.slope_y, r.slope_y));
        u = hn::Add(u, hn::Set(d, static_cast<double>(kParts)));
      }
      sum[0] = hn::Add(sum[0], row_points);
      sum[2] = hn::Add(sum[2], hn::Mul(row_points, v));
      sum[6] = hn::Add(sum[6], row_slope_y);
      sum[8] = hn::Add(sum[8], hn::Mul(row_slope_y, v));
    }
    for (int s = 0; s < kSums; ++s) {
      hn::StoreU(sum[s], d, parts[s] + part);
    }
  }
  sums = {total(parts[0]), total(parts[1]), total(parts[2]), total(parts[3]), total(parts[4]),
          total(parts[5]), total(parts[6]), total(parts[7]), total(parts[8])};
  return hn::AllTrue(d, hn::Gt(nearest, hn::Zero(d)));
}

HWY_ATTR bool maxResidual(const CloudRows& rows, const double f[2], const double c[2], double& residual)
{
  const D d;
  const auto fx = hn::Set(d, f[0]), fy = hn::Set(d, f[1]);
  auto nearest = hn::Set(d, 1.0);
  auto largest = hn::Zero(d);
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    const std::size_t first = row * rows.width, end = first + rows.width;
    const auto from_v = hn::Set(d, c[1] - static_cast<double>(row));
    auto u = hn::Iota(d, 0.0);
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
      const Rays r = rays(load(rows.x, i, end), load(rows.y, i, end), load(rows.z, i, end));
      nearest = hn::Min(nearest, r.depth);
      const auto du = hn::Abs(hn::Add(hn::Mul(fx, r.slope_x), hn::Sub(hn::Set(d, c[0]), u)));
      const auto dv = hn::Abs(hn::Add(hn::Mul(fy, r.slope_y), from_v));
      largest = hn::Max(largest, hn::IfThenElseZero(r.measured, hn::Max(du, dv)));
      u = hn::Add(u, hn::Set(d, static_cast<double>(hn::Lanes(d))));
    }
  }
  double lanes[kParts];
  hn::StoreU(largest, d, lanes);
  residual = *std::max_element(lanes, lanes + hn::Lanes(d));
  return hn::AllTrue(d, hn::Gt(nearest, hn::Zero(d)));
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(sumRays);
HWY_EXPORT(maxResidual);

bool sumRays(const CloudRows& rows, RaySums& sums)
{
  return HWY_DYNAMIC_DISPATCH(sumRays)(rows, sums);
}

bool maxResidual(const CloudRows& rows, const double f[2], const double c[2], double& residual)
{
  return HWY_DYNAMIC_DISPATCH(maxResidual)(rows, f, c, residual);
}

}  // namespace grasp_affordances
#endif
