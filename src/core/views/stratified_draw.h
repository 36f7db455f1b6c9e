#pragma once

#include "grasp_affordances/config.h"

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Draws the point of the i-th of `config.samples` samples. Where there are at least as many candidates as samples, the
/// list of candidates is divided into as many equal parts (strata), and the point is drawn from the i-th of them. Where
/// there are fewer candidates, the first samples get one candidate each, and all other samples a point that is drawn
/// uniformly from the measured ones. Depends on the lists, `config.samples`, `config.seed` and i alone.
/// @return index of the point in the cloud
std::uint32_t drawStratified(const std::vector<std::uint32_t>& measured, const std::vector<std::uint32_t>& candidates,
                             const SamplingConfig& config, std::uint64_t i);

}  // namespace grasp_affordances
