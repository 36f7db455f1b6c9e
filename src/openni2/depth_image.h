#pragma once

#include <OpenNI.h>

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// An image as OpenNI2 delivers it: rows of pixels. There may be unused bytes between two rows.
struct RawImage
{
  const void* data = nullptr;
  std::size_t bytes = 0;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;  ///< bytes from one row to the next
  openni::PixelFormat format = openni::PIXEL_FORMAT_DEPTH_1_MM;
};

/// Size and pixel format of the images of a stream.
struct ImageLayout
{
  int width = 0;
  int height = 0;
  openni::PixelFormat format = openni::PIXEL_FORMAT_DEPTH_1_MM;  ///< one that supportedVideoMode() accepts
  bool mirrored = false;  ///< left and right are exchanged; recordings often are mirrored
};

/// Whether an image has the size and format of its stream. An interrupted USB transfer leaves an image of another size,
/// or a part of one.
bool isIntact(const RawImage& image, const ImageLayout& layout);

/// Correction of measured depth. A depth d in millimetres becomes (d + z_offset_mm) * z_scaling. The names are those of
/// openni2_camera.
struct DepthCorrection
{
  double z_scaling = 1.0;
  int z_offset_mm = 0;
};

/// Writes the depth image in millimetres, rounded, row by row without gaps and not mirrored (REP 118). 0 means "not
/// measured" and stays 0. A corrected depth below 1 mm or above 65535 mm becomes 0. The image must be intact.
/// @param[out] depth  width x height values
void depthMillimetres(const RawImage& image, const ImageLayout& layout, const DepthCorrection& correction,
                      std::uint16_t* depth);

/// Writes the color image as bytes r g b, row by row without gaps and not mirrored. The image must be intact.
/// @param[out] rgb  3 x width x height bytes
void rgbBytes(const RawImage& image, const ImageLayout& layout, std::uint8_t* rgb);

}  // namespace grasp_affordances
