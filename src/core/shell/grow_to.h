#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Makes memory at least as large as a size. Where it has to grow, it grows to twice its size or more.
template <typename Number>
void growTo(std::size_t size, std::vector<Number>& memory)
{
  if (size > memory.size()) {
    memory.resize(std::max(size, 2 * memory.size()));
  }
}

}  // namespace grasp_affordances
