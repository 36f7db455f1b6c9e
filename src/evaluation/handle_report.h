#pragma once

#include "evaluation/report_format.h"
#include "evaluation/summary.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// One row per handle. @throw std::runtime_error for a file that cannot be written.
void writeHandles(const std::string& path, const Evaluation& evaluation);

/// Names of the columns that addHandleColumns() fills, each after a comma.
std::string handleColumns();
void addHandleColumns(const HandleScore& score, CsvTable& table);

nlohmann::json handleJson(const HandleScore& score);

/// Per variation one table of the scenes.
std::string markdownHandleTables(const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

}  // namespace grasp_affordances
