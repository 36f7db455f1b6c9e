#pragma once

#include <cstddef>

namespace grasp_affordances
{

/// A pinhole camera's image (see PinholeIntrinsics).
struct PinholeImage
{
  double fx, fy, cx, cy;
  double width, height;
};

/// Finds the pixel that each point (m) falls on, the same as RangeImage::pixel.
/// @param count  number of points, a multiple of kLookupGroup
/// @param pixels  row-major indices, out; -1 outside the image and behind the sensor
constexpr std::size_t kLookupGroup = 8;
void lookUpPixels(const PinholeImage& image, const double* const points[3], std::size_t count, double* pixels);

}  // namespace grasp_affordances
