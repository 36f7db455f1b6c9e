#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The seeds of words that are each a number, "7", or a range, "101:120".
/// @throw std::invalid_argument for a word that is neither, a range of more than 100000 seeds, and a seed that is given
/// twice
std::vector<std::uint64_t> seedList(const std::vector<std::string>& words);

}  // namespace grasp_affordances
