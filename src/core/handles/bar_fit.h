#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// A round bar about a line. It may taper: its radius changes evenly along the line.
struct FittedBar
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, on the axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit
  double radius = 0.0;                               ///< m, at the origin
  double taper = 0.0;                                ///< change of the radius (m) per m along the axis
};

/// How far the fitted bar is expected to be from the start: standard deviations of a normal prior.
struct BarPrior
{
  double tilt = 0.1;     ///< rad, of the axis
  double taper = 0.1;    ///< m per m, of the taper
  double radius = 0.01;  ///< m, of the radius
  double place = 0.01;   ///< m, of the axis at the origin
};

/// Fits a bar to points. It minimizes their geometric distance from the surface, which unlike the algebraic distance is
/// not biased on short arcs. The method is Gauss-Newton with Tukey's biweight, so that points that are not of the bar
/// count little.
/// @param start  where the fit begins. The fitted origin lies in the plane through the start's origin at right angles
/// to its axis
/// @param noise  m, standard deviation of a point's distance from the surface
/// @return empty where the fit diverges, or where fewer than six points are near the surface
std::optional<FittedBar> fitBar(const std::vector<Eigen::Vector3d>& points, const FittedBar& start,
                                const BarPrior& prior, double noise);

}  // namespace grasp_affordances
