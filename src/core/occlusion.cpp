#include "grasp_affordances/occlusion.h"

#include "core/pixel_rows.h"
#include "core/window_scan.h"

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{

bool occluded(const RangeImage& image, const Neighborhood& neighborhood, std::size_t max_points_in_front,
              double min_distance)
{
  float closest = closestSquaredRange(neighborhood.x(), neighborhood.y(), neighborhood.z(), neighborhood.size());
  if (min_distance > 0.0) {
    const double nearer = std::max(0.0, std::sqrt(static_cast<double>(closest)) - min_distance);
    closest = static_cast<float>(nearer * nearer);
  }
  const Eigen::Vector3f& center = neighborhood.center;
  const ViewCone cone{{center.x(), center.y(), center.z()},
                      center.squaredNorm() - neighborhood.radius * neighborhood.radius};
  const PixelWindow window = image.window(center.cast<double>(), neighborhood.radius);
  return countNearer(pixelRows(image.cloud(), window), cone, closest, max_points_in_front) > max_points_in_front;
}

}  // namespace grasp_affordances
