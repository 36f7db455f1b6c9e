#pragma once

#include "core/parallel/random.h"

#include <cstdint>

namespace grasp_affordances
{

/// What random numbers are drawn for; each use has its own, whatever the others draw.
enum class RandomStream : std::uint64_t
{
  placement,    ///< of the objects and the camera of a scene
  disparity,    ///< noise of the matching
  edge_column,  ///< jitter of depth edges along the rows
  edge_row,     ///< and along the columns
  edge_loss,    ///< what is not measured at depth edges
  reflection,   ///< what is not measured for lack, or excess, of light
  transparency  ///< what is measured of a transparent surface
};

/// Counter-based random numbers (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011): the n-th draw
/// is a hash of (seed, stream, index, n), so that pixels can be drawn in any order by any number of threads. Only
/// integer and exactly rounded floating-point arithmetic: the same numbers on every platform, unlike the distributions
/// of the standard library.
class CounterRandom
{
public:
  CounterRandom(std::uint64_t seed, RandomStream stream, std::uint64_t index = 0)
      : key_(randomBits(seed, static_cast<std::uint64_t>(stream), index))
  {
  }

  std::uint64_t bits() { return splitMix64(key_ + counter_++); }

  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  bool coin() { return (bits() >> 63) != 0; }

  /// Mean 0, variance 1, as the sum of twelve uniform numbers: no logarithm, whose last digits depend on the platform.
  /// Its tails end at 6 standard deviations.
  double normal()
  {
    std::int64_t sum = 0;
    for (int word = 0; word < 3; ++word) {
      for (std::uint64_t rest = bits(), part = 0; part < 4; ++part, rest >>= 16)
        sum += static_cast<std::int64_t>(rest & 0xffff);
    }
    return static_cast<double>(sum - 6 * 0xffff) * 0x1p-16;
  }

private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace grasp_affordances
