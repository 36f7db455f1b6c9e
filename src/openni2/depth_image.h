#pragma once

#include <OpenNI.h>

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// A picture as OpenNI2 hands it out: rows of pixels, with or without a gap between them.
struct RawImage
{
  const void* data = nullptr;
  std::size_t bytes = 0;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;  ///< bytes from one row to the next
  openni::PixelFormat format = openni::PIXEL_FORMAT_DEPTH_1_MM;
};

/// What the pictures of a stream look like.
struct ImageLayout
{
  int width = 0;
  int height = 0;
  openni::PixelFormat format = openni::PIXEL_FORMAT_DEPTH_1_MM;  ///< one of those of supportedVideoMode()
  bool mirrored = false;  ///< left and right are exchanged, as programs of OpenNI2 like to record
};

/// Whether a picture is what its stream promises; a transfer that was torn leaves one of another size, or half of one.
bool isIntact(const RawImage& image, const ImageLayout& layout);

/// Correction of measured depth, with openni2_camera's names: a depth d becomes (d + z_offset_mm) z_scaling.
struct DepthCorrection
{
  double z_scaling = 1.0;
  int z_offset_mm = 0;
};

/// Depth in millimetres, rounded, row by row without gaps and not mirrored (REP 118). 0, not measured, stays 0, and
/// what the correction takes below 1 mm or beyond 65535 mm becomes it. The picture must be intact.
void depthMillimetres(const RawImage& image, const ImageLayout& layout, const DepthCorrection& correction,
                      std::uint16_t* depth);

/// Colors as bytes r g b, row by row without gaps and not mirrored. The picture must be intact.
void rgbBytes(const RawImage& image, const ImageLayout& layout, std::uint8_t* rgb);

}  // namespace grasp_affordances
