#pragma once

namespace grasp_affordances::fuzz
{

/// Ten thousand points in as few neighborhoods as can be, in several shapes and under every estimator: each cloud is
/// localized in with one thread in a second of processor time at most. More than a fuzzer can try.
void runCrowds();

}  // namespace grasp_affordances::fuzz
