#pragma once

#include "evaluation/runtime.h"
#include "evaluation/summary.h"

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The summary as markdown: per variation one table of the scenes for the shells, then one for the handles, and a table
/// of recall over samples where that is varied.
std::string markdownTables(const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

/// Writes shells.csv, handles.csv, affordances.csv, summary.csv, summary.json, table.md and, where the sampling is
/// varied, samples.csv into a folder; docs/evaluation.md describes their columns. @throw std::runtime_error for a file
/// that cannot be written.
void writeReport(const std::string& folder, const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

/// Writes runtime.csv. @throw std::runtime_error as writeReport.
void writeRuntimes(const std::string& folder, const std::vector<Runtime>& runtimes);

}  // namespace grasp_affordances
