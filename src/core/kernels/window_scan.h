#pragma once

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// A rectangle of pixels in an organized cloud's coordinate arrays (m), NaN where nothing was measured.
struct PixelRows
{
  const float* x;
  const float* y;
  const float* z;
  std::size_t points;  ///< in the arrays
  std::size_t first;   ///< index of the rectangle's first pixel
  std::size_t rows;
  std::size_t columns;
  std::size_t stride;  ///< from row to row
};

/// Numbers that kernels may write beyond the last one that counts.
constexpr std::size_t kGatherSlack = 16;

/// Where points are gathered: arrays with room for all pixels of the rectangle and kGatherSlack more.
struct GatheredPoints
{
  float* x;
  float* y;
  float* z;
  std::uint32_t* index;  ///< null: indices are not asked for
};

/// What a rectangle holds of a sphere.
struct SphereSurvey
{
  std::size_t points;       ///< with squaredLength(p - center) <= squared_radius
  float closest;            ///< smallest squaredLength(p) of those points; infinity for none
  float closest_in_window;  ///< the same of all points of the rectangle
};

/// Looks at the sphere only: closest_in_window, which may be anything then, is zero.
SphereSurvey surveySphere(const PixelRows& window, const float center[3], float squared_radius);

/// Copies the points of the sphere, too, in the order of their indices.
SphereSurvey gatherSphere(const PixelRows& window, const float center[3], float squared_radius,
                          const GatheredPoints& gathered);

/// The smallest squaredLength(p) of `count` points; infinity for none.
float closestSquaredRange(const float* x, const float* y, const float* z, std::size_t count);

/// The cone of rays from the sensor, at the origin, that meet a sphere: those whose angle with the centre's direction
/// has a squared cosine of at least 1 - radius^2 / |center|^2; all where the sensor is inside the sphere.
struct ViewCone
{
  float center[3];
  float tangent;  ///< |center|^2 - radius^2
};

/// Number of points in the cone with squaredLength(p) < squared_range. From the last row to the first, since what is
/// nearer most often is lower in the image; rows that follow when there are more than `enough` are left out.
std::size_t countNearer(const PixelRows& window, const ViewCone& cone, float squared_range, std::size_t enough);

}  // namespace grasp_affordances
