#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The tables of a suite as markdown: what was evaluated; then, per preset and capture radius, handles, shells, where
/// samples on missed affordances ended, and how often handles are right by score. Rows are those of the grid, columns
/// its sensors and backgrounds.
/// @param cells  with their results, as SuiteStore gives them
std::string suiteTables(const std::vector<nlohmann::json>& cells);

}  // namespace grasp_affordances
