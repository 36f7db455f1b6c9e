#pragma once

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// Some rows [begin, end) of an organized cloud's coordinate arrays.
struct CloudRows
{
  const float *x, *y, *z;  // of the whole cloud
  std::size_t width;       // columns
  std::size_t begin, end;
};

/// Sums over measured points for the regression of their pixels (u, v) on the slopes x/z and y/z of their rays.
struct RaySums
{
  double points, u, v;
  double slope_x, slope_x2, slope_x_u;
  double slope_y, slope_y2, slope_y_v;

  RaySums& operator+=(const RaySums& other)
  {
    points += other.points, u += other.u, v += other.v;
    slope_x += other.slope_x, slope_x2 += other.slope_x2, slope_x_u += other.slope_x_u;
    slope_y += other.slope_y, slope_y2 += other.slope_y2, slope_y_v += other.slope_y_v;
    return *this;
  }
};

/// @return false where a point has z <= 0.
bool sumRays(const CloudRows& rows, RaySums& sums);

/// The largest distance (pixels, along columns or rows) of a point from its own pixel, under the projection
/// u = f[0] x / z + c[0], v = f[1] y / z + c[1]. @return false where a point has z <= 0.
bool maxResidual(const CloudRows& rows, const double f[2], const double c[2], double& residual);

}  // namespace grasp_affordances
