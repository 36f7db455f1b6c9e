#pragma once

#include "evaluation/evaluation.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Whether the tables of a suite count an affordance: one that shows at least 200 points.
bool isCounted(const Affordance& affordance);

/// By the outcomes' names, those that are not 0.
nlohmann::json endsJson(const OutcomeCounts& ends);

/// What the tables of a suite tell of one variation on some frames, at least one. docs/evaluation.md describes it.
nlohmann::json numbersJson(const std::vector<const FrameResult*>& frames, std::size_t variation);

}  // namespace grasp_affordances
