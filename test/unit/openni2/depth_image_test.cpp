#include "openni2/depth_image.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

template <typename Pixel>
RawImage rawImage(const std::vector<Pixel>& pixels, int width, int height, openni::PixelFormat format,
                  std::size_t bytes_per_row)
{
  return {pixels.data(), pixels.size() * sizeof(Pixel), width, height, bytes_per_row, format};
}

std::vector<std::uint16_t> converted(const std::vector<std::uint16_t>& raw, openni::PixelFormat format,
                                     const DepthCorrection& correction)
{
  const int width = static_cast<int>(raw.size());
  std::vector<std::uint16_t> depth(raw.size(), 7);
  depthMillimetres(rawImage(raw, width, 1, format, 2 * raw.size()), {width, 1, format, false}, correction,
                   depth.data());
  return depth;
}

using Depths = std::vector<std::uint16_t>;

TEST(DepthImage, MillimetresStayAsTheyAre)
{
  const Depths raw = {0, 1, 800, 10000, 65535};
  EXPECT_EQ(converted(raw, openni::PIXEL_FORMAT_DEPTH_1_MM, {}), raw);
}

TEST(DepthImage, TenthsOfMillimetresAreRounded)
{
  EXPECT_EQ(converted({0, 4, 5, 8004, 8006, 65535}, openni::PIXEL_FORMAT_DEPTH_100_UM, {}),
            (Depths{0, 0, 1, 800, 801, 6554}));
}

TEST(DepthImage, TheOffsetComesBeforeTheScale)
{
  EXPECT_EQ(converted({0, 1000}, openni::PIXEL_FORMAT_DEPTH_1_MM, {1.1, 10}), (Depths{0, 1111}));
  EXPECT_EQ(converted({0, 10000}, openni::PIXEL_FORMAT_DEPTH_100_UM, {1.1, 10}), (Depths{0, 1111}));
}

TEST(DepthImage, WhatTheCorrectionTakesOutOfRangeIsNotMeasured)
{
  EXPECT_EQ(converted({99, 100, 101}, openni::PIXEL_FORMAT_DEPTH_1_MM, {1.0, -100}), (Depths{0, 0, 1}));
  EXPECT_EQ(converted({43690, 43691, 65535}, openni::PIXEL_FORMAT_DEPTH_1_MM, {1.5, 0}), (Depths{65535, 0, 0}));
}

TEST(DepthImage, RowsMayHaveAGapAndBeMirrored)
{
  const Depths raw = {1, 2, 3, 99, 4, 5, 6, 99};
  const RawImage image = rawImage(raw, 3, 2, openni::PIXEL_FORMAT_DEPTH_1_MM, 8);
  Depths depth(6);
  depthMillimetres(image, {3, 2, image.format, false}, {}, depth.data());
  EXPECT_EQ(depth, (Depths{1, 2, 3, 4, 5, 6}));
  depthMillimetres(image, {3, 2, image.format, true}, {}, depth.data());
  EXPECT_EQ(depth, (Depths{3, 2, 1, 6, 5, 4}));
}

TEST(DepthImage, ColorsAreMirroredPixelByPixel)
{
  const std::vector<std::uint8_t> raw = {1, 2, 3, 4, 5, 6};
  const RawImage image = rawImage(raw, 2, 1, openni::PIXEL_FORMAT_RGB888, 6);
  std::vector<std::uint8_t> rgb(6);
  rgbBytes(image, {2, 1, image.format, false}, rgb.data());
  EXPECT_EQ(rgb, raw);
  rgbBytes(image, {2, 1, image.format, true}, rgb.data());
  EXPECT_EQ(rgb, (std::vector<std::uint8_t>{4, 5, 6, 1, 2, 3}));
}

TEST(DepthImage, TornPicturesAreNoticed)
{
  const ImageLayout layout{3, 2, openni::PIXEL_FORMAT_DEPTH_1_MM, false};
  const Depths raw(6);
  const RawImage whole = rawImage(raw, 3, 2, layout.format, 6);
  EXPECT_TRUE(isIntact(whole, layout));

  std::vector<RawImage> torn(9, whole);
  torn[0].data = nullptr;
  torn[1].bytes = 11;
  torn[2].bytes = 14;
  torn[3].width = 2;
  torn[4].height = 1;
  torn[5].stride = 4;
  torn[5].bytes = 8;
  torn[6].format = openni::PIXEL_FORMAT_DEPTH_100_UM;
  torn[7].stride = -whole.stride;  // as a device says them that gives a negative number of bytes
  torn[7].bytes = -whole.bytes;
  torn[8].height = -2;
  torn[8].bytes = -whole.bytes;
  for (const RawImage& image : torn) {
    EXPECT_FALSE(isIntact(image, layout)) << &image - torn.data();
  }
}

}  // namespace
}  // namespace grasp_affordances
