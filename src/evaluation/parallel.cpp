#include "evaluation/parallel.h"

#include "core/parallel/std_team.h"

namespace grasp_affordances
{

void forEachInParallel(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& job)
{
  StdTeam(static_cast<int>(threads)).forEach(count, [&](std::size_t i, std::size_t /*member*/) { job(i); });
}

}  // namespace grasp_affordances
