#pragma once

#include <cstddef>
#include <functional>

namespace grasp_affordances
{

/// Calls job(0), ..., job(count - 1), each once, in any order, from as many threads (0: one per core). After a job that
/// throws no further ones are begun. @throw what the first such job threw
void forEachInParallel(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& job);

}  // namespace grasp_affordances
