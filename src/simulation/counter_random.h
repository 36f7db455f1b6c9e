#pragma once

#include "core/parallel/random.h"

#include <cstdint>

namespace grasp_affordances
{

/// Purpose of random numbers. Each purpose has its own stream, independent of the others.
enum class RandomStream : std::uint64_t
{
  placement,     ///< sizes and places of the objects and the camera of a scene
  disparity,     ///< noise of the stereo matching
  edge_column,   ///< jitter of depth edges along the rows
  edge_row,      ///< jitter of depth edges along the columns
  edge_loss,     ///< missing pixels at depth edges
  reflection,    ///< missing pixels where too little or too much light returns
  transparency,  ///< which surface is measured at a transparent one
  background,    ///< sizes and places of what is behind the objects
  flying         ///< pixels at depth edges that are anywhere between the two surfaces
};

/// Counter-based random numbers (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011). The n-th draw
/// is a hash of (seed, stream, index, n), so that any number of threads can draw for pixels in any order. All
/// arithmetic is on integers or is exactly rounded. The numbers are therefore the same on every platform, unlike those
/// of the standard library's distributions.
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

  /// Approximately normal, with mean 0 and variance 1: the sum of twelve uniform numbers. No logarithm is used, because
  /// its last digits depend on the platform. The tails end at 6 standard deviations.
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
