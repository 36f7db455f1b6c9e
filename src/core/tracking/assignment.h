#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace grasp_affordances
{

/// Assigns columns to rows, at most one to each, so that the sum of the costs is the least. The sum has the cost of
/// each pair, and `alone` for each row without a column. The method is the Hungarian one with shortest augmenting
/// paths; its time is cubic in the size. Deterministic, even where several assignments have the same cost.
/// @param costs  of each row with each column, at least 0; infinity for pairs that are not allowed
/// @param alone  finite, at least 0
/// @return the column of each row; empty for a row without one
std::vector<std::optional<Eigen::Index>> cheapestAssignment(const Eigen::MatrixXd& costs, double alone);

}  // namespace grasp_affordances
