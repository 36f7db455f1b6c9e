#include "openni2/depth_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr double kLargest = 65535.0;  // mm

std::size_t bytesPerPixel(openni::PixelFormat format)
{
  return format == openni::PIXEL_FORMAT_RGB888 ? 3 : sizeof(std::uint16_t);
}

/// Copies all rows without the gaps between them. A pixel of the image has the size of Pixel.
template <typename Pixel>
void copyRows(const RawImage& image, bool mirrored, Pixel* pixels)
{
  for (int row = 0; row < image.height; ++row, pixels += image.width) {
    std::memcpy(pixels, static_cast<const std::uint8_t*>(image.data) + row * image.stride, image.width * sizeof(Pixel));
    if (mirrored) {
      std::reverse(pixels, pixels + image.width);
    }
  }
}

}  // namespace

bool isIntact(const RawImage& image, const ImageLayout& layout)
{
  // A device may report negative numbers, which are larger than this as std::size_t.
  constexpr std::size_t kLargest = std::numeric_limits<int>::max();
  return image.stride <= kLargest && image.bytes <= kLargest && image.data != nullptr && image.width == layout.width &&
         image.height == layout.height && image.format == layout.format &&
         image.stride >= image.width * bytesPerPixel(image.format) && image.bytes == image.stride * image.height;
}

void depthMillimetres(const RawImage& image, const ImageLayout& layout, const DepthCorrection& correction,
                      std::uint16_t* depth)
{
  copyRows(image, layout.mirrored, depth);
  const double unit = image.format == openni::PIXEL_FORMAT_DEPTH_100_UM ? 0.1 : 1.0;
  if (unit == 1.0 && correction.z_scaling == 1.0 && correction.z_offset_mm == 0) {
    return;
  }
  const auto corrected = [&](std::uint16_t raw) {
    const double d = std::round((raw * unit + correction.z_offset_mm) * correction.z_scaling);
    return static_cast<std::uint16_t>(raw == 0 || d < 1.0 || d > kLargest ? 0.0 : d);
  };
  std::transform(depth, depth + std::size_t{1} * image.width * image.height, depth, corrected);
}

void rgbBytes(const RawImage& image, const ImageLayout& layout, std::uint8_t* rgb)
{
  using Rgb = std::array<std::uint8_t, 3>;
  copyRows(image, layout.mirrored, reinterpret_cast<Rgb*>(rgb));
}

}  // namespace grasp_affordances
