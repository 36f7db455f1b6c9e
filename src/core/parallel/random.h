#pragma once

#include <cstdint>

namespace grasp_affordances
{

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014): a hash of 64 bits.
inline std::uint64_t splitMix64(std::uint64_t x)
{
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// Counter-based random bits: the value depends on the seed and the counters alone. So every sample draws for itself,
/// in any order and on any thread, and gets the same on every platform.
inline std::uint64_t randomBits(std::uint64_t seed, std::uint64_t counter, std::uint64_t stream = 0)
{
  return splitMix64(splitMix64(splitMix64(seed) + counter) + stream);
}

/// A draw from 0, ..., count - 1; `count` must be at least 1. Uniform to within count / 2^32.
inline std::uint32_t randomIndex(std::uint64_t bits, std::uint32_t count)
{
  return static_cast<std::uint32_t>(((bits >> 32U) * count) >> 32U);
}

}  // namespace grasp_affordances
