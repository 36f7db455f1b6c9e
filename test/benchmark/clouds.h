#pragma once

#include "grasp_affordances/cloud.h"

#include <string>
#include <vector>

namespace grasp_affordances::test
{

/// A cloud to measure times on.
struct NamedCloud
{
  std::string name;
  Cloud cloud;
};

/// "learn33", a recorded table scene, where the recordings are there; and "cleaning2", a scene of the paper's as the
/// virtual Xtion sees it.
std::vector<NamedCloud> benchmarkClouds();

}  // namespace grasp_affordances::test
