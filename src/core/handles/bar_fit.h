#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// A round bar about a line, as wide as its radius at the line's origin; it may taper.
struct FittedBar
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, on the axis, at the height of the start's origin
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit
  double radius = 0.0;                               ///< m, at the origin
  double taper = 0.0;                                ///< m of radius per m along the axis
};

/// How far the fit may stray from where it starts: standard deviations, as if they had been measured.
struct BarPrior
{
  double tilt = 0.1;     ///< rad, of the axis
  double taper = 0.1;    ///< of the taper from the start's
  double radius = 0.01;  ///< m, of the radius
  double place = 0.01;   ///< m, of the axis at the origin
};

/// The bar from whose surface the points are least far: the geometric distance, which unlike the algebraic one is not
/// biased on short arcs, by Gauss and Newton with Tukey's weights, so that what is not of the bar counts little.
/// @param noise  m, standard deviation of a point's distance from the surface
/// @return empty where it diverges or fewer than six points are near
std::optional<FittedBar> fitBar(const std::vector<Eigen::Vector3d>& points, const FittedBar& start,
                                const BarPrior& prior, double noise);

}  // namespace grasp_affordances
