#pragma once

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The instruction sets that the kernels are compiled for and this processor has, the best first and scalar code last.
std::vector<std::string> instructionSets();

/// Makes all kernels use one of instructionSets(); an empty name: the best one again. For tests. Must not be called
/// while kernels run. @throw std::invalid_argument for another name
void useInstructionSet(const std::string& name);

}  // namespace grasp_affordances
