#pragma once

#include "core/cloud/range_image.h"
#include "core/kernels/window_scan.h"
#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>

namespace grasp_affordances
{

/// What the sensor sees of a sphere.
struct SphereView
{
  Eigen::Vector3f center;  ///< m
  float radius;            ///< m
  PixelWindow window;      ///< holds the sphere's image
  SphereSurvey survey;
};

/// What the sensor sees of a neighborhood's sphere. The window is not searched: the survey's closest_in_window is 0, so
/// that occluded() looks for points in front.
SphereView viewOf(const Neighborhood& neighborhood, const RangeImage& image);

/// As occluded() in occlusion.h, for the neighborhood of all points in the sphere.
bool occluded(const RangeImage& image, const SphereView& sphere, std::size_t max_points_in_front, double min_distance);

}  // namespace grasp_affordances
