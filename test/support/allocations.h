#pragma once

// Replaces the global operator new to watch allocations. For the one source file of a test executable.

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace grasp_affordances::test
{

inline std::atomic<std::size_t> allocations{0};         // since the start of the process
inline std::atomic<std::size_t> largest_allocation{0};  // bytes; a test sets it back to 0

}  // namespace grasp_affordances::test

void* operator new(std::size_t size)
{
  using grasp_affordances::test::largest_allocation;
  ++grasp_affordances::test::allocations;
  std::size_t largest = largest_allocation;
  while (size > largest && !largest_allocation.compare_exchange_weak(largest, size)) {
  }
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
