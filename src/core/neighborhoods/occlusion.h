#pragma once

#include "core/cloud/range_image.h"
#include "core/neighborhoods/neighborhoods.h"

#include <cstddef>

namespace grasp_affordances
{

/// FilterOcclusion (Algorithm 1, step 5): whether something nearer to the sensor hides a part of the neighborhood.
///
/// The circle that the neighborhood's sphere projects to is taken exactly, as the cone of rays that meet the sphere.
/// True where more than `max_points_in_front` measured points in the cone are closer to the sensor (Euclidean range),
/// by more than `min_distance` (m), than the closest point of the neighborhood. The cloud's origin is the sensor.
///
/// With a distance of zero, as in the paper, a surface that slopes away from the sensor occludes itself: the cone meets
/// it nearer to the sensor than the sphere does, by R (tan s - sin s) for a slope s and a sphere of radius R.
bool occluded(const RangeImage& image, const Neighborhood& neighborhood, std::size_t max_points_in_front,
              double min_distance);

}  // namespace grasp_affordances
