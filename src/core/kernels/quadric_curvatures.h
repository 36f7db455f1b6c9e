#pragma once

#include <cstddef>

namespace grasp_affordances
{

/// A quadric in plain numbers: x'Ax + b'x + c.
struct QuadricCoefficients
{
  double xx, yy, zz, xy, yz, xz;  ///< entries of A: of the mixed monomials half the coefficient
  double x, y, z;
  double constant;
};

/// Points (local coordinates), and what is found out about them. Arrays with room for a multiple of kCurvatureBatch
/// numbers.
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
  std::size_t concave = 0;  ///< of the valid: the centre of curvature lies on the sensor's side
};

/// Puts points onto the quadric by one Newton step along the gradient and takes the square of the larger principal
/// curvature there, from mean and Gaussian curvature; infinity where the step leaves the unit sphere or there is no
/// curvature. `sensor`: local coordinates, tells on which side of the surface it is seen from.
CurvatureCounts quadricCurvatures(const QuadricCoefficients& quadric, const double sensor[3], std::size_t count,
                                  const CurvaturePoints& points);

}  // namespace grasp_affordances
