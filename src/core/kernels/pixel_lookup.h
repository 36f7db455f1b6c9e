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

/// The row-major index of the pixel that each point (m) falls on; -1 outside the image and behind the sensor. Numbers
/// of points are multiples of kLookupGroup. The same pixels as RangeImage::pixel.
constexpr std::size_t kLookupGroup = 8;
void lookUpPixels(const PinholeImage& image, const double* const points[3], std::size_t count, double* pixels);

}  // namespace grasp_affordances
