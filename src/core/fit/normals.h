#pragma once

#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// Surface normals of a cloud's points, as coordinate arrays. Unit vectors of arbitrary sign; NaN where there is none.
struct Normals
{
  std::vector<float> x, y, z;

  void reset(std::size_t points);
  void set(std::size_t index, const Eigen::Vector3d& normal);
  Eigen::Vector3f normal(std::size_t index) const { return {x[index], y[index], z[index]}; }
};

/// The normal of the plane that fits the points best: the eigenvector of the smallest eigenvalue of their covariance.
/// Empty for points that span no plane.
std::optional<Eigen::Vector3d> planeNormal(const Neighborhood& neighborhood);

}  // namespace grasp_affordances
