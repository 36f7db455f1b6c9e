#pragma once

#include "evaluation/runtime.h"
#include "evaluation/summary.h"

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The summary as markdown: per preset and estimator one table of the scenes.
std::string markdownTables(const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

/// Writes shells.csv, affordances.csv, summary.csv, summary.json and table.md into a folder; docs/evaluation.md
/// describes their columns. @throw std::runtime_error for a file that cannot be written.
void writeReport(const std::string& folder, const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

/// Writes runtime.csv. @throw std::runtime_error as writeReport.
void writeRuntimes(const std::string& folder, const std::vector<Runtime>& runtimes);

}  // namespace grasp_affordances
