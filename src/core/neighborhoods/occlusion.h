#pragma once

#include "core/cloud/range_image.h"
#include "core/neighborhoods/neighborhoods.h"

#include <cstddef>

namespace grasp_affordances
{

/// FilterOcclusion (Algorithm 1, step 5): whether something nearer to the sensor hides a part of the neighborhood.
///
/// Looks at the measured points in the circle that the neighborhood's sphere projects to, exactly: at the cone of rays
/// that meet the sphere. A point is in front where it is closer to the sensor (Euclidean range), by more than
/// `min_distance` (m), than the closest point of the neighborhood. More than `max_points_in_front` points in front
/// occlude the neighborhood. The sensor is at the origin.
///
/// With a distance of zero, as in the paper, a surface that slopes away from the sensor occludes itself: the cone meets
/// it nearer to the sensor than the sphere does, by R (tan s - sin s) for a slope s and a sphere of radius R.
bool occluded(const RangeImage& image, const Neighborhood& neighborhood, std::size_t max_points_in_front,
              double min_distance);

}  // namespace grasp_affordances
