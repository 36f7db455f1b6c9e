#pragma once

#include "core/kernels/instruction_sets.h"

#include <gtest/gtest.h>

namespace grasp_affordances::test
{

/// Runs a test of kernels with every instruction set that they are compiled for and the processor has.
template <typename Body>
void forEachInstructionSet(Body&& body)
{
  for (const std::string& name : instructionSets()) {
    SCOPED_TRACE(name);
    useInstructionSet(name);
    body();
  }
  useInstructionSet("");
}

}  // namespace grasp_affordances::test
