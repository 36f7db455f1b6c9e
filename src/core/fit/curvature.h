#pragma once

#include "core/fit/quadric.h"
#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace grasp_affordances
{

/// Principal curvature of larger magnitude at a point of a quadric.
struct PrincipalCurvature
{
  double value = 0.0;  ///< in the inverse of the quadric's local unit; positive where the surface bends away from the
                       ///< side that its gradient points to, as of a sphere whose gradient points outwards
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit tangent about which the surface curves most: the cross
                                                    ///< product of the normal with the direction of this curvature
};

/// From the shape operator: the Hessian restricted to the tangent plane, over the gradient's norm (paper, section
/// III-B). `x` in local coordinates; the gradient there must not vanish. Where both curvatures are equal (a sphere) the
/// axis is some tangent.
PrincipalCurvature principalCurvature(const Quadric& quadric, const Eigen::Vector3d& x);

/// The larger principal curvature over a neighborhood.
struct NeighborhoodCurvature
{
  double median = 0.0;                              ///< 1/m, of the magnitudes
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit, curvature axis at the median point
  bool concave = false;  ///< whether at most points the centre of curvature lies on the sensor's side; false where the
                         ///< sensor's place is not known
};

/// Working memory of medianCurvature, one per thread.
struct CurvatureScratch
{
  Eigen::Array<double, Eigen::Dynamic, 5> points;  // local x, y, z, squared curvature, and that again to be sorted
};

/// The sensor that saw the first points of a neighborhood.
struct SeenFrom
{
  std::optional<Eigen::Vector3d> sensor;                         ///< m, in the cloud's frame; empty: not known
  std::size_t points = std::numeric_limits<std::size_t>::max();  ///< number of them; all, where there are fewer
};

/// Evenly spaced points that are drawn from a list.
struct EvenDraw
{
  std::size_t count;          ///< all, where there are fewer
  std::uint64_t random_bits;  ///< decide which is the first
};

/// Draws from those points of the neighborhood that the sensor saw. Puts each onto the quadric by one Newton step along
/// the gradient, discards those that leave the neighborhood, and takes the median of the larger principal curvature's
/// magnitude (paper, section III-B). Normals are turned towards the sensor before signs are judged. Empty where no
/// point is left.
std::optional<NeighborhoodCurvature> medianCurvature(const Quadric& quadric, const Neighborhood& neighborhood,
                                                     const SeenFrom& seen, const EvenDraw& draw,
                                                     CurvatureScratch& scratch);

}  // namespace grasp_affordances
