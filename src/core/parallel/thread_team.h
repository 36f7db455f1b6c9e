#pragma once

#ifdef GRASP_AFFORDANCES_STD_THREADS
#include "core/parallel/std_team.h"
#else
#include "core/parallel/tbb_team.h"
#endif

namespace grasp_affordances
{

#ifdef GRASP_AFFORDANCES_STD_THREADS
using TeamOfThreads = StdTeam;
#else
using TeamOfThreads = TbbTeam;
#endif

/// A bounded number of threads that share the work on a cloud. The only code that knows of threads.
class ThreadTeam : public TeamOfThreads
{
public:
  using TeamOfThreads::TeamOfThreads;
};

}  // namespace grasp_affordances
