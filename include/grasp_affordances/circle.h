#pragma once

#include "grasp_affordances/neighborhoods.h"

#include <Eigen/Core>

#include <optional>

namespace grasp_affordances
{

struct Circle
{
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< m, along the two base vectors, from the neighborhood's centre
  double radius = 0.0;                               ///< m
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();    ///< m, of the projected points, likewise
};

/// Circle of least algebraic distance through the neighborhood's points projected along an axis onto the plane of
/// the orthonormal vectors `first` and `second` (paper, section IV-A, with l_i = (x, y, 1)). Empty for projections that
/// lie on a line. On arcs much shorter than the circle, with noise, the algebraic fit is biased towards small radii:
/// see docs/accuracy.md.
std::optional<Circle> fitCircle(const Neighborhood& neighborhood, const Eigen::Vector3d& first,
                                const Eigen::Vector3d& second);

}  // namespace grasp_affordances
