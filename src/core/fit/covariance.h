#pragma once

#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <optional>

namespace grasp_affordances
{

/// The symmetric matrix of the moments of second degree. @param sums  by momentIndex
Eigen::Matrix3d secondMoments(const double* sums);

/// Covariance (divided by n) of the neighborhood's points, in units of its radius. Zero for no points or no radius.
Eigen::Matrix3d covariance(const Neighborhood& neighborhood);

enum class Extreme
{
  smallest,
  largest
};

/// The unit eigenvector of the smallest or largest eigenvalue of a symmetric matrix. Empty where the next eigenvalue is
/// the same to rounding, and where the matrix is not finite.
std::optional<Eigen::Vector3d> distinctEigenvector(const Eigen::Matrix3d& symmetric, Extreme extreme);

}  // namespace grasp_affordances
