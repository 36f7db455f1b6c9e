#pragma once

#include "core/fit/quadric.h"
#include "core/neighborhoods/neighborhoods.h"

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

/// Projects the neighborhood's points onto the plane of the orthonormal vectors `first` and `second`, and fits the
/// circle of least algebraic distance to them (paper, section IV-B, with l_i = (x, y, 1)). Empty where the projected
/// points lie on a line. On short arcs with noise the algebraic fit is biased towards small radii: see
/// docs/accuracy.md.
std::optional<Circle> fitCircle(const Neighborhood& neighborhood, const Eigen::Vector3d& first,
                                const Eigen::Vector3d& second);

/// The same from the neighborhood's moments. @param scale  m, the neighborhood's radius
std::optional<Circle> fitCircle(const Moments& moments, double scale, const Eigen::Vector3d& first,
                                const Eigen::Vector3d& second);

/// Sums over points of a plane (m), where s = xx + yy.
struct PlaneMoments
{
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, sx = 0.0, sy = 0.0, ss = 0.0;
};

/// Fits a circle to points of a plane by Taubin's method: it minimises the algebraic distance over its gradient, which
/// is not biased towards small radii (G. Taubin, "Estimation of planar curves, surfaces and nonplanar space curves
/// defined by implicit equations", PAMI 13, 1991; Newton's method as in N. Chernov, "Circular and linear regression",
/// 2010, section 5.9). The origin should be no farther from the points than a few radii. Empty for fewer than three
/// points and for points on a line. `center` and `mean` are in the points' own frame.
std::optional<Circle> fitCircleTaubin(const PlaneMoments& moments);

}  // namespace grasp_affordances
