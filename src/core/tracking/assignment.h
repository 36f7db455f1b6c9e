#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace grasp_affordances
{

/// Assigns columns to rows, each to one at most, such that the sum of the costs is the least: those of the pairs, and
/// `alone` for every row without a column. (Hungarian method by shortest augmenting paths; cubic in the size.)
/// Deterministic, also where several assignments cost the same.
/// @param costs  at least 0; of pairs that must not be, infinity
/// @param alone  finite, at least 0
/// @return of each row, its column
std::vector<std::optional<Eigen::Index>> cheapestAssignment(const Eigen::MatrixXd& costs, double alone);

}  // namespace grasp_affordances
