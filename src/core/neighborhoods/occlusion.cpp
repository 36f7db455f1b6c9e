#include "core/neighborhoods/occlusion.h"

#include "core/cloud/pixel_rows.h"
#include "core/neighborhoods/sphere_view.h"

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{

bool occluded(const RangeImage& image, const SphereView& sphere, std::size_t max_points_in_front, double min_distance)
{
  float closest = sphere.survey.closest;
  if (min_distance > 0.0) {
    const double nearer = std::max(0.0, std::sqrt(static_cast<double>(closest)) - min_distance);
    closest = static_cast<float>(nearer * nearer);
  }
  if (!(sphere.survey.closest_in_window < closest)) {
    return false;
  }
  const Eigen::Vector3f& center = sphere.center;
  const ViewCone cone{{center.x(), center.y(), center.z()}, center.squaredNorm() - sphere.radius * sphere.radius};
  return countNearer(pixelRows(image.cloud(), sphere.window), cone, closest, max_points_in_front) > max_points_in_front;
}

SphereView viewOf(const Neighborhood& neighborhood, const RangeImage& image)
{
  SphereView sphere;
  sphere.center = neighborhood.center;
  sphere.radius = neighborhood.radius;
  sphere.window = image.window(neighborhood.center.cast<double>(), neighborhood.radius);
  sphere.survey.points = neighborhood.size();
  sphere.survey.closest =
      closestSquaredRange(neighborhood.x(), neighborhood.y(), neighborhood.z(), neighborhood.size());
  sphere.survey.closest_in_window = 0.0F;
  return sphere;
}

bool occluded(const RangeImage& image, const Neighborhood& neighborhood, std::size_t max_points_in_front,
              double min_distance)
{
  return occluded(image, viewOf(neighborhood, image), max_points_in_front, min_distance);
}

}  // namespace grasp_affordances
