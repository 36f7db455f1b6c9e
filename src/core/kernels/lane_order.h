#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

constexpr std::size_t kOrderedLanes = 8;

/// A table: for each set of up to 8 lanes, given as bits, the lanes of the set in their order, then zeros.
constexpr auto makeLaneOrder()
{
  std::array<std::array<std::uint8_t, kOrderedLanes>, 1U << kOrderedLanes> order{};
  for (std::size_t bits = 0; bits < order.size(); ++bits) {
    std::size_t place = 0;
    for (std::uint8_t lane = 0; lane < kOrderedLanes; ++lane) {
      if ((bits >> lane & 1U) != 0) {
        order[bits][place++] = lane;
      }
    }
  }
  return order;
}
inline constexpr auto kLaneOrder = makeLaneOrder();

}  // namespace grasp_affordances
