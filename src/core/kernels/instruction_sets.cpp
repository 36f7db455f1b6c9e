#include "core/kernels/instruction_sets.h"

#include <cstdint>
#include <stdexcept>

#ifdef GRASP_AFFORDANCES_HIGHWAY
#include <hwy/highway.h>
#endif

namespace grasp_affordances
{
#ifdef GRASP_AFFORDANCES_HIGHWAY

std::vector<std::string> instructionSets()
{
  std::vector<std::string> names;
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    names.emplace_back(hwy::TargetName(target));
  }
  return names;
}

void useInstructionSet(const std::string& name)
{
  std::int64_t chosen = 0;
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    chosen |= name == hwy::TargetName(target) ? target : 0;
  }
  if (chosen == 0 && !name.empty()) {
    throw std::invalid_argument("no instruction set " + name);
  }
  hwy::SetSupportedTargetsForTest(chosen);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
#else
std::vector<std::string> instructionSets()
{
  return {"portable"};
}

void useInstructionSet(const std::string& name)
{
  if (!name.empty() && name != "portable") {
    throw std::invalid_argument("no instruction set " + name);
  }
}
#endif

}  // namespace grasp_affordances
