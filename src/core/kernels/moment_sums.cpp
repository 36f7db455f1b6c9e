#include "core/kernels/moment_sums.h"

#include <algorithm>
#include <array>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/moment_sums.cpp"
#include "core/kernels/simd.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

// Each moment is summed in so many parts; point i adds to the part number i modulo kParts.
constexpr std::size_t kParts = 8;
using D = hn::CappedTag<double, kParts>;

// Points are summed a tile at a time: a tile stays in the processor's nearest memory while each moment runs over it.
constexpr std::size_t kTile = 32;
using Tile = std::array<double, kTile>;

/// The points of a tile, in coordinates from the centre.
struct Coordinates
{
  alignas(64) std::array<Tile, 3> of;
};
struct Sums
{
  alignas(64) std::array<std::array<double, kParts>, kMomentCount> parts;
};

constexpr int kTerms = 10;  // moments of degree at most 2

// Each moment of a higher degree is a sum of products of two terms. The table tells which terms.
struct Factors
{
  int first, second;
};
constexpr std::array<Factors, kMomentCount> makeFactors()
{
  std::array<Factors, kMomentCount> factors{};
  for (int degree = 3; degree <= 4; ++degree) {
    for (int k = 0; k <= degree; ++k) {
      for (int j = 0; j + k <= degree; ++j) {
        // The first factor is of degree 2.
        const int i = degree - j - k;
        const int di = i < 2 ? i : 2;
        const int dj = j < 2 - di ? j : 2 - di;
        const int dk = 2 - di - dj;
        factors[momentIndex(i, j, k)] = {momentIndex(di, dj, dk), momentIndex(i - di, j - dj, k - dk)};
      }
    }
  }
  return factors;
}
constexpr std::array<Factors, kMomentCount> kFactors = makeFactors();

/// Writes coordinate - middle for `count` points, and zeros, which add nothing, beyond them.
HWY_ATTR HWY_INLINE void subtract(const float* coordinate, std::size_t count, double middle, Tile& tile)
{
  const D d;
  const hn::Rebind<float, D> single;
  const auto center = hn::Set(d, middle);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    hn::Store(hn::Sub(hn::PromoteTo(d, hn::LoadU(single, coordinate + i)), center), d, &tile[i]);
  }
  for (; i < count; ++i) {
    tile[i] = static_cast<double>(coordinate[i]) - middle;
  }
  std::fill(tile.begin() + i, tile.end(), 0.0);
}

/// Adds the moments First + I of a tile: as many at a time as there are registers for their sums. The terms are
/// computed anew each time, which costs less than storing and loading them.
template <std::size_t First, std::size_t... I>
HWY_ATTR HWY_INLINE void addMoments(const Coordinates& coordinates, Sums& sums, std::index_sequence<I...>)
{
  const D d;
  const auto moment = [](const hn::Vec<D>* term, auto index) HWY_ATTR {
    constexpr std::size_t m = decltype(index)::value;
    if constexpr (m < kTerms) {
      return term[m];
    } else {
      return hn::Mul(term[kFactors[m].first], term[kFactors[m].second]);
    }
  };
  for (std::size_t part = 0; part < kParts; part += hn::Lanes(d)) {
    hn::Vec<D> sum[] = {hn::Load(d, &sums.parts[First + I][part])...};
#pragma GCC unroll 4
    for (std::size_t i = part; i < kTile; i += kParts) {
      const auto x = hn::Load(d, &coordinates.of[0][i]), y = hn::Load(d, &coordinates.of[1][i]),
                 z = hn::Load(d, &coordinates.of[2][i]);
      const hn::Vec<D> term[kTerms] = {x,
                                       x,
                                       y,
                                       z,
                                       hn::Mul(x, x),
                                       hn::Mul(x, y),
                                       hn::Mul(y, y),
                                       hn::Mul(x, z),
                                       hn::Mul(y, z),
                                       hn::Mul(z, z)};  // the first is not used
      ((sum[I] = hn::Add(sum[I], moment(term, std::integral_constant<std::size_t, First + I>()))), ...);
    }
    (hn::Store(sum[I], d, &sums.parts[First + I][part]), ...);
  }
}

HWY_ATTR void sumMoments(const float* const coordinates[3], std::size_t count, const double center[3], double* moments,
                         int degree)
{
  Coordinates local;
  Sums sums{};
  for (std::size_t begin = 0; begin < count; begin += kTile) {
    const std::size_t size = std::min(kTile, count - begin);
    for (int axis = 0; axis < 3; ++axis) {
      subtract(coordinates[axis] + begin, size, center[axis], local.of[axis]);
    }
    addMoments<1>(local, sums, std::make_index_sequence<9>());
    if (degree > 2) {
      addMoments<10>(local, sums, std::make_index_sequence<10>());
    }
    if (degree > 3) {
      addMoments<20>(local, sums, std::make_index_sequence<15>());
    }
  }
  moments[0] = static_cast<double>(count);
  for (int m = 1; m < momentCount(degree); ++m) {
    const auto& part = sums.parts[m];
    moments[m] = ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(sumMoments);

void sumMoments(const float* const coordinates[3], std::size_t count, const double center[3], double* moments,
                int degree)
{
  HWY_DYNAMIC_DISPATCH(sumMoments)(coordinates, count, center, moments, degree);
}

}  // namespace grasp_affordances
#endif
