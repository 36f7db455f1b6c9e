#pragma once

#include "core/fit/normals.h"
#include "core/fit/quadric.h"
#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace grasp_affordances
{

/// The PCA variation: the unit eigenvector of the largest eigenvalue of the points' covariance (paper, section V-A).
/// Empty where the two largest eigenvalues are the same to rounding: the points have no longest direction.
std::optional<Eigen::Vector3d> pointsAxis(const Neighborhood& neighborhood);

/// The same from the neighborhood's moments, of degree 2 at least.
std::optional<Eigen::Vector3d> pointsAxis(const Moments& moments);

/// The Normals variation: the unit eigenvector of the smallest eigenvalue of the sum of n n' over the neighborhood's
/// surface normals (paper, section V-A). Empty where the two smallest eigenvalues are the same to rounding: the normals
/// of a plane have no such axis.
std::optional<Eigen::Vector3d> normalsAxis(const Neighborhood& neighborhood, const Normals& normals);

/// The sum of n n' over the normals of `count` points, given by their indices. Points without a normal add nothing.
Eigen::Matrix3d normalsScatter(const Normals& normals, const std::uint32_t* points, std::size_t count);

/// The same axis from that sum.
std::optional<Eigen::Vector3d> normalsAxis(const Eigen::Matrix3d& scatter);

}  // namespace grasp_affordances
