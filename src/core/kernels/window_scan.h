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

/// How many numbers kernels may write beyond the last valid one.
constexpr std::size_t kGatherSlack = 16;

/// Where points are gathered: arrays with room for all pixels of the rectangle and kGatherSlack more.
struct GatheredPoints
{
  float* x;
  float* y;
  float* z;
  std::uint32_t* index;  ///< null: indices are not asked for
};

/// What is known of the points of a rectangle that lie within a sphere.
struct SphereSurvey
{
  std::size_t points;       ///< with squaredLength(p - center) <= squared_radius
  float closest;            ///< smallest squaredLength(p) of those points; infinity for none
  float closest_in_window;  ///< smallest squaredLength(p) of all points of the rectangle; infinity for none
};

/// Surveys the points within the sphere. It does not look at the other points: closest_in_window is zero, as where
/// something may be in front.
SphereSurvey surveySphere(const PixelRows& window, const float center[3], float squared_radius);

/// Surveys the sphere and the rectangle, and copies the points within the sphere, in the order of their indices.
SphereSurvey gatherSphere(const PixelRows& window, const float center[3], float squared_radius,
                          const GatheredPoints& gathered);

/// Copies the points within the sphere, with their indices, as gatherSphere does; surveys nothing.
/// @return how many
std::size_t gatherUnsurveyed(const PixelRows& window, const float center[3], float squared_radius,
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

/// Counts the points in the cone with squaredLength(p) < squared_range, until there are more than `enough`. Goes from
/// the last row to the first, since nearer things are most often lower in the image.
std::size_t countNearer(const PixelRows& window, const ViewCone& cone, float squared_range, std::size_t enough);

}  // namespace grasp_affordances
