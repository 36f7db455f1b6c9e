#include "core/moment_sums.h"

#include <algorithm>
#include <array>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/moment_sums.cpp"
#include "core/simd.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

// Each moment is summed in this many parts, of which point i adds to that of i modulo their number.
constexpr std::size_t kParts = 8;
using D = hn::CappedTag<double, kParts>;

// Points are summed a tile at a time, which stays in the processor's nearest memory while each moment runs over it.
constexpr std::size_t kTile = 32;
using Tile = std::array<double, kTile>;

constexpr int kTerms = 10;  // moments of degree at most 2
struct Terms
{
  alignas(64) std::array<Tile, kTerms> of;  // by momentIndex; [0], the constant, is not used
};
struct Sums
{
  alignas(64) std::array<std::array<double, kParts>, kMomentCount> parts;
};

// Each moment of degree 2 or more is the sum of products of two terms: the table tells which.
struct Factors
{
  int first, second;
};
constexpr std::array<Factors, kMomentCount> makeFactors()
{
  std::array<Factors, kMomentCount> factors{};
  for (int degree = 2; degree <= 4; ++degree) {
    for (int k = 0; k <= degree; ++k) {
      for (int j = 0; j + k <= degree; ++j) {
        // Of a degree above 2 the first factor takes two units, of degree 2 one.
        const int units = degree > 2 ? 2 : 1;
        const int i = degree - j - k;
        const int di = i < units ? i : units;
        const int dj = j < units - di ? j : units - di;
        const int dk = units - di - dj;
        factors[momentIndex(i, j, k)] = {momentIndex(di, dj, dk), momentIndex(i - di, j - dj, k - dk)};
      }
    }
  }
  return factors;
}
constexpr std::array<Factors, kMomentCount> kFactors = makeFactors();

/// coordinate - middle of `count` points; zero, which adds nothing, beyond them.
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

HWY_ATTR HWY_INLINE void multiply(const Tile& a, const Tile& b, Tile& product)
{
  const D d;
  for (std::size_t i = 0; i < kTile; i += hn::Lanes(d)) {
    hn::Store(hn::Mul(hn::Load(d, &a[i]), hn::Load(d, &b[i])), d, &product[i]);
  }
}

/// Adds a tile's moments First + I, a few at a time, so that their sums stay in registers.
template <std::size_t First, std::size_t... I>
HWY_ATTR HWY_INLINE void addMoments(const Terms& terms, Sums& sums, std::index_sequence<I...>)
{
  const D d;
  const auto moment = [&](auto index, std::size_t i) HWY_ATTR {
    constexpr std::size_t m = decltype(index)::value;
    if constexpr (m < kTerms) {
      return hn::Load(d, &terms.of[m][i]);
    } else {
      return hn::Mul(hn::Load(d, &terms.of[kFactors[m].first][i]), hn::Load(d, &terms.of[kFactors[m].second][i]));
    }
  };
  for (std::size_t part = 0; part < kParts; part += hn::Lanes(d)) {
    hn::Vec<D> sum[] = {hn::Load(d, &sums.parts[First + I][part])...};
    for (std::size_t i = part; i < kTile; i += kParts) {
      ((sum[I] = hn::Add(sum[I], moment(std::integral_constant<std::size_t, First + I>(), i))), ...);
    }
    (hn::Store(sum[I], d, &sums.parts[First + I][part]), ...);
  }
}

/// Adds the moments of degree 1 and 2 of `count` points, a multiple of kParts, without a detour through memory.
HWY_ATTR HWY_INLINE void addSecondMoments(const float* const coordinates[3], std::size_t count, const double center[3],
                                          Sums& sums)
{
  const D d;
  const hn::Rebind<float, D> single;
  const auto cx = hn::Set(d, center[0]), cy = hn::Set(d, center[1]), cz = hn::Set(d, center[2]);
  for (std::size_t part = 0; part < kParts; part += hn::Lanes(d)) {
    hn::Vec<D> sum[kTerms];
    for (int m = 1; m < kTerms; ++m) {
      sum[m] = hn::Load(d, &sums.parts[m][part]);
    }
    for (std::size_t i = part; i < count; i += kParts) {
      const auto x = hn::Sub(hn::PromoteTo(d, hn::LoadU(single, coordinates[0] + i)), cx);
      const auto y = hn::Sub(hn::PromoteTo(d, hn::LoadU(single, coordinates[1] + i)), cy);
      const auto z = hn::Sub(hn::PromoteTo(d, hn::LoadU(single, coordinates[2] + i)), cz);
      sum[momentIndex(1, 0, 0)] = hn::Add(sum[momentIndex(1, 0, 0)], x);
      sum[momentIndex(0, 1, 0)] = hn::Add(sum[momentIndex(0, 1, 0)], y);
      sum[momentIndex(0, 0, 1)] = hn::Add(sum[momentIndex(0, 0, 1)], z);
      sum[momentIndex(2, 0, 0)] = hn::Add(sum[momentIndex(2, 0, 0)], hn::Mul(x, x));
      sum[momentIndex(1, 1, 0)] = hn::Add(sum[momentIndex(1, 1, 0)], hn::Mul(x, y));
      sum[momentIndex(0, 2, 0)] = hn::Add(sum[momentIndex(0, 2, 0)], hn::Mul(y, y));
      sum[momentIndex(1, 0, 1)] = hn::Add(sum[momentIndex(1, 0, 1)], hn::Mul(x, z));
      sum[momentIndex(0, 1, 1)] = hn::Add(sum[momentIndex(0, 1, 1)], hn::Mul(y, z));
      sum[momentIndex(0, 0, 2)] = hn::Add(sum[momentIndex(0, 0, 2)], hn::Mul(z, z));
    }
    for (int m = 1; m < kTerms; ++m) {
      hn::Store(sum[m], d, &sums.parts[m][part]);
    }
  }
}

HWY_ATTR void sumMoments(const float* const coordinates[3], std::size_t count, const double center[3], double* moments,
                         int degree)
{
  Terms terms;
  Sums sums{};
  std::size_t begin = 0;
  if (degree == 2) {
    begin = count - count % kParts;
    addSecondMoments(coordinates, begin, center, sums);
  }
  for (; begin < count; begin += kTile) {
    const std::size_t size = std::min(kTile, count - begin);
    for (int axis = 0; axis < 3; ++axis) {
      subtract(coordinates[axis] + begin, size, center[axis], terms.of[1 + axis]);
    }
    for (int m = 4; m < kTerms; ++m) {
      multiply(terms.of[kFactors[m].first], terms.of[kFactors[m].second], terms.of[m]);
    }
    addMoments<1>(terms, sums, std::make_index_sequence<9>());
    if (degree > 2) {
      addMoments<10>(terms, sums, std::make_index_sequence<10>());
    }
    if (degree > 3) {
      addMoments<20>(terms, sums, std::make_index_sequence<8>());
      addMoments<28>(terms, sums, std::make_index_sequence<7>());
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
