#include "grasp_affordances/hidden_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace grasp_affordances::test
{
namespace
{

constexpr std::uint32_t kWidth = 160, kHeight = 120;
const PinholeIntrinsics kCamera{140.0, 140.0, 79.5, 59.5};
constexpr double kWidest = 1.0;  // m

/// What an image with a depth per pixel (m; NaN: not measured) shows.
struct Image
{
  explicit Image(const std::function<double(std::uint32_t u, std::uint32_t v)>& depth)
  {
    cloud.reset(kWidth, kHeight);
    cloud.intrinsics = kCamera;
    for (std::uint32_t v = 0; v < kHeight; ++v) {
      for (std::uint32_t u = 0; u < kWidth; ++u) {
        const double z = depth(u, v);
        cloud.set(v * kWidth + u, static_cast<float>((u - kCamera.cx) / kCamera.fx * z),
                  static_cast<float>((v - kCamera.cy) / kCamera.fy * z), static_cast<float>(z));
      }
    }
  }

  Cloud continued(double max_width = kWidest) const
  {
    std::string warning;
    return continueSurfaces(*RangeImage::create(cloud, warning), max_width);
  }

  Cloud cloud;
};

/// Depth of the plane n p = 1 at a pixel.
double planeDepth(const Eigen::Vector3d& n, std::uint32_t u, std::uint32_t v)
{
  return 1.0 / n.dot(Eigen::Vector3d((u - kCamera.cx) / kCamera.fx, (v - kCamera.cy) / kCamera.fy, 1.0));
}

bool inRectangle(std::uint32_t u, std::uint32_t v)
{
  return u >= 60 && u < 100 && v >= 40 && v < 80;
}

constexpr std::size_t kHiddenPoints = 40 * 40 * 3 / 4;  // of the rectangle: on every other row and column

const Eigen::Vector3d kSlantedTable(0.1, 0.7, 0.9);

std::size_t measuredPoints(const Cloud& cloud)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    count += cloud.measured(i) ? 1 : 0;
  }
  return count;
}

TEST(HiddenSurfaces, APlaneGoesOnBehindWhatIsBeforeIt)
{
  const Image image([](std::uint32_t u, std::uint32_t v) {
    const double table = planeDepth(kSlantedTable, u, v);
    return inRectangle(u, v) ? 0.7 * table : table;
  });
  const Cloud hidden = image.continued();
  for (std::uint32_t v = 0; v < kHeight; ++v) {
    for (std::uint32_t u = 0; u < kWidth; ++u) {
      const std::size_t pixel = v * kWidth + u;
      ASSERT_EQ(hidden.measured(pixel), inRectangle(u, v) && (u % 2 == 0 || v % 2 == 0)) << u << ", " << v;
      if (hidden.measured(pixel)) {
        // Rounding of depths to single precision, and ten lengths of a stretch to bridge.
        ASSERT_NEAR(kSlantedTable.dot(hidden.point(pixel).cast<double>()), 1.0, 1e-5);
      }
    }
  }
}

TEST(HiddenSurfaces, APlaneGoesOnWhereNothingWasMeasured)
{
  const Image image([](std::uint32_t u, std::uint32_t v) {
    return inRectangle(u, v) ? std::nan("") : planeDepth(kSlantedTable, u, v);
  });
  EXPECT_EQ(measuredPoints(image.continued()), kHiddenPoints);
}

TEST(HiddenSurfaces, NothingIsContinuedWhereTheSensorSawBeyond)
{
  const Image hole([](std::uint32_t u, std::uint32_t v) {
    const double table = planeDepth(kSlantedTable, u, v);
    return inRectangle(u, v) ? 1.3 * table : table;
  });
  EXPECT_EQ(measuredPoints(hole.continued()), 0U);

  // A post before the middle of the hole: beside it the sensor still sees through.
  const Image post([](std::uint32_t u, std::uint32_t v) {
    const double table = planeDepth(kSlantedTable, u, v);
    return u >= 75 && u < 85 ? 0.7 * table : inRectangle(u, v) ? 1.3 * table : table;
  });
  const Cloud hidden = post.continued();
  for (std::uint32_t v = 40; v < 80; ++v) {
    EXPECT_TRUE(!hidden.measured(v * kWidth + 80) ||
                hidden.z[v * kWidth + 80] > 1.1 * planeDepth(kSlantedTable, 80, v));
  }
}

TEST(HiddenSurfaces, TwoDifferentSurfacesAreNotJoined)
{
  // Boards at different depths on either side of a post, each ending at it.
  const Image image([](std::uint32_t u, std::uint32_t) { return u < 70 ? 1.0 : u < 90 ? 0.6 : 1.1; });
  EXPECT_EQ(measuredPoints(image.continued()), 0U);
}

TEST(HiddenSurfaces, BridgesNoMoreThanTheLargestWidth)
{
  const Image image([](std::uint32_t u, std::uint32_t v) { return inRectangle(u, v) ? 0.7 : 1.0; });
  const double width = 41 / kCamera.fx;  // m, at a depth of 1 m
  EXPECT_EQ(measuredPoints(image.continued(1.01 * width)), kHiddenPoints);
  EXPECT_EQ(measuredPoints(image.continued(0.99 * width)), 0U);
}

TEST(HiddenSurfaces, AnEmptyTableHidesNothing)
{
  const Image image([](std::uint32_t u, std::uint32_t v) { return planeDepth(kSlantedTable, u, v); });
  EXPECT_EQ(measuredPoints(image.continued()), 0U);
}

}  // namespace
}  // namespace grasp_affordances::test
