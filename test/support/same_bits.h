#pragma once

#include <cstdint>
#include <cstring>

namespace grasp_affordances::test
{

/// Equal to the last bit: NaN is the same as itself, and 0 not as -0.
inline bool sameBits(double a, double b)
{
  std::uint64_t bits_of_a = 0, bits_of_b = 0;
  std::memcpy(&bits_of_a, &a, sizeof(a));
  std::memcpy(&bits_of_b, &b, sizeof(b));
  return bits_of_a == bits_of_b;
}

}  // namespace grasp_affordances::test
