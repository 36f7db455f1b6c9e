#include "nodelets/roscpp/subscribing.h"

namespace grasp_affordances
{

std::mutex& subscribing()
{
  static std::mutex of_this_process;
  return of_this_process;
}

}  // namespace grasp_affordances
