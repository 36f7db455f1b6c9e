#include "grasp_affordances/occlusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace grasp_affordances
{

bool occluded(const RangeImage& image, const Neighborhood& neighborhood, std::size_t max_points_in_front,
              double min_distance)
{
  float closest = std::numeric_limits<float>::infinity();  // squared range
  for (std::size_t i = 0; i < neighborhood.size(); ++i) {
    closest = std::min(closest, squaredLength(neighborhood.x()[i], neighborhood.y()[i], neighborhood.z()[i]));
  }
  if (min_distance > 0.0) {
    const double nearer = std::max(0.0, std::sqrt(static_cast<double>(closest)) - min_distance);
    closest = static_cast<float>(nearer * nearer);
  }

  // A ray meets the sphere where its angle with the centre's direction has (cos)^2 >= 1 - radius^2 / |center|^2; where
  // the sensor is inside the sphere every ray does.
  const float cx = neighborhood.center.x(), cy = neighborhood.center.y(), cz = neighborhood.center.z();
  const float tangent = neighborhood.center.squaredNorm() - neighborhood.radius * neighborhood.radius;
  const float least_along = tangent > 0.0F ? 0.0F : -std::numeric_limits<float>::infinity();

  const Cloud& cloud = image.cloud();
  const PixelWindow window = image.window(neighborhood.center.cast<double>(), neighborhood.radius);
  const std::size_t columns = static_cast<std::size_t>(window.u_end - window.u_begin);
  std::uint32_t in_front = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const std::size_t first = static_cast<std::size_t>(v) * cloud.width + static_cast<std::size_t>(window.u_begin);
    const float *x = &cloud.x[first], *y = &cloud.y[first], *z = &cloud.z[first];
    for (std::size_t i = 0; i < columns; ++i) {
      const float range = squaredLength(x[i], y[i], z[i]);
      const float along = x[i] * cx + y[i] * cy + z[i] * cz;
      // Bitwise, so that the loop has no branch; false for NaN.
      in_front += static_cast<std::uint32_t>(range < closest) & static_cast<std::uint32_t>(along >= least_along) &
                  static_cast<std::uint32_t>(along * along >= tangent * range);
    }
    if (in_front > max_points_in_front) {
      return true;
    }
  }
  return false;
}

}  // namespace grasp_affordances
