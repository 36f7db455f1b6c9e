#pragma once

#ifdef GRASP_AFFORDANCES_STD_THREADS
#include "core/parallel/std_team.h"
#else
#include <tbb/parallel_for.h>
#endif

#include <cstddef>

namespace grasp_affordances
{

/// Calls task(row) for every row < height, each once, in any order, from as many threads as there are cores.
template <typename Row, typename Task>
void forEachRow(Row height, Task&& task)
{
#ifdef GRASP_AFFORDANCES_STD_THREADS
  StdTeam(0).forEach(static_cast<std::size_t>(height),
                     [&](std::size_t row, std::size_t /*member*/) { task(static_cast<Row>(row)); });
#else
  tbb::parallel_for(Row{0}, height, task);
#endif
}

}  // namespace grasp_affordances
