#pragma once

#include "evaluation/summary.h"

#include <string>
#include <vector>

namespace grasp_affordances
{

/// Recall of shells and of handles over the number of samples, with and without importance sampling, as one markdown
/// table. Of scenes and groups of scenes only the latter where there are any.
std::string markdownSampleTable(const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

/// The same of all scenes and groups. @throw std::runtime_error for a file that cannot be written.
void writeSamples(const std::string& path, const Evaluation& evaluation, const std::vector<SummaryRow>& rows);

}  // namespace grasp_affordances
