#pragma once

#include "core/cloud/range_image.h"
#include "core/kernels/window_scan.h"
#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>

namespace grasp_affordances
{

/// A sphere as the sensor sees it, and what is known of its points before they are gathered.
struct SphereView
{
  Eigen::Vector3f center;  ///< m
  float radius;            ///< m
  PixelWindow window;      ///< that it projects to
  SphereSurvey survey;
};

/// That of a neighborhood, whose window is not searched: its closest point is taken to be anywhere.
SphereView viewOf(const Neighborhood& neighborhood, const RangeImage& image);

/// As occluded() for the neighborhood in the sphere.
bool occluded(const RangeImage& image, const SphereView& sphere, std::size_t max_points_in_front, double min_distance);

}  // namespace grasp_affordances
