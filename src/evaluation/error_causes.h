#pragma once

#include "evaluation/errors.h"

#include <string>

namespace grasp_affordances
{

/// Where the samples on an affordance in error ended, added up over the runs with that error.
OutcomeCounts endsOn(const Evaluation& evaluation, const Error& error);

/// What errors are grouped by. "missed: low_curvature": most samples on it ended there; "missed: no sample on it"; "no
/// handle of its shells", "several handles", "wrong handle on table", "wrong shell on table", where "on table" stands
/// where it is known.
std::string causeOf(const Evaluation& evaluation, const Error& error);

}  // namespace grasp_affordances
