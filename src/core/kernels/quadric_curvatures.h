#pragma once

#include <cstddef>

namespace grasp_affordances
{

/// A quadric in plain numbers: x'Ax + b'x + c.
struct QuadricCoefficients
{
  double xx, yy, zz, xy, yz, xz;  ///< entries of A; those of mixed monomials are half the coefficient
  double x, y, z;
  double constant;
};

/// Points (local coordinates) and the curvature at each. Arrays with room for a multiple of kCurvatureBatch numbers.
struct CurvaturePoints
{
  double* x;
  double* y;
  double* z;
  double* squared_curvature;
};
constexpr std::size_t kCurvatureBatch = 8;

struct CurvatureCounts
{
  std::size_t valid = 0;
  std::size_t concave = 0;  ///< number of valid points whose centre of curvature lies on the sensor's side
};

/// Puts points onto the quadric by one Newton step along the gradient, and takes the square of the larger principal
/// curvature there, from mean and Gaussian curvature. A point is not valid, and gets infinity, where the step leaves
/// the unit sphere or where there is no curvature.
/// @param sensor  local coordinates; tells from which side the surface is seen
CurvatureCounts quadricCurvatures(const QuadricCoefficients& quadric, const double sensor[3], std::size_t count,
                                  const CurvaturePoints& points);

}  // namespace grasp_affordances
