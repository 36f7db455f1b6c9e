#pragma once

#include <cstdint>

namespace grasp_affordances
{

/// Counter-based random bits (SplitMix64): the value depends on the seed and the counters alone, so that every sample
/// draws for itself, in any order, on any thread, with the same result on any platform.
inline std::uint64_t randomBits(std::uint64_t seed, std::uint64_t counter, std::uint64_t stream = 0)
{
  const auto mix = [](std::uint64_t s) {
    s += 0x9E3779B97F4A7C15U;
    s = (s ^ (s >> 30U)) * 0xBF58476D1CE4E5B9U;
    s = (s ^ (s >> 27U)) * 0x94D049BB133111EBU;
    return s ^ (s >> 31U);
  };
  return mix(mix(mix(seed) + counter) + stream);
}

/// A draw from 0, ..., count - 1; `count` must be at least 1. Uniform to within count / 2^32.
inline std::uint32_t randomIndex(std::uint64_t bits, std::uint32_t count)
{
  return static_cast<std::uint32_t>(((bits >> 32U) * count) >> 32U);
}

}  // namespace grasp_affordances
