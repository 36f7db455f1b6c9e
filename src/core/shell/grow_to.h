#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Grows memory to a size, and where it must, to twice what it was.
template <typename Number>
void growTo(std::size_t size, std::vector<Number>& memory)
{
  if (size > memory.size()) {
    memory.resize(std::max(size, 2 * memory.size()));
  }
}

}  // namespace grasp_affordances
