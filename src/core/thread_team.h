#pragma once

#ifdef GRASP_AFFORDANCES_STD_THREADS
#include "core/std_team.h"
#else
#include "core/tbb_team.h"
#endif

namespace grasp_affordances
{

/// A bounded number of threads that share the work on a cloud. The only code that knows of threads.
#ifdef GRASP_AFFORDANCES_STD_THREADS
using ThreadTeam = StdTeam;
#else
using ThreadTeam = TbbTeam;
#endif

}  // namespace grasp_affordances
