#include "core/views/hidden_surfaces.h"

#include "core/kernels/instruction_sets.h"
#include "core/parallel/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

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

/// Boxes at random places before a table, in image sizes that are no multiples of anything; depths in steps of a
/// structured-light sensor, a few of them missing.
Cloud clutter(std::uint64_t seed, std::uint32_t width, std::uint32_t height)
{
  const auto draw = [seed](std::uint64_t i, std::uint64_t stream) {
    return static_cast<double>(randomBits(seed, i, stream) >> 11U) * 0x1p-53;
  };
  Cloud cloud;
  cloud.reset(width, height);
  cloud.intrinsics = kCamera;
  for (std::uint32_t v = 0; v < height; ++v) {
    for (std::uint32_t u = 0; u < width; ++u) {
      double z = planeDepth(kSlantedTable, u, v);
      for (std::uint64_t box = 0; box < 12; ++box) {
        const double left = draw(box, 0) * width, top = draw(box, 1) * height, size = 5 + 25 * draw(box, 2);
        const bool inside = u >= left && u < left + size && v >= top && v < top + size;
        z = inside ? std::min(z, (0.7 + 0.3 * draw(box, 3)) * planeDepth(kSlantedTable, u, v)) : z;
      }
      const std::uint64_t pixel = v * width + u;
      constexpr double kStep = 0.003;  // 1/m
      z = 1.0 / (kStep * std::round((1.0 / z + 0.002 * (draw(pixel, 4) - 0.5)) / kStep));
      z = draw(pixel, 5) < 0.03 ? std::nan("") : z;
      cloud.set(pixel, static_cast<float>((u - kCamera.cx) / kCamera.fx * z),
                static_cast<float>((v - kCamera.cy) / kCamera.fy * z), static_cast<float>(z));
    }
  }
  return cloud;
}

/// The definition, pixel by pixel, on one row or column: inverse depths.
class PlainScanLine
{
public:
  explicit PlainScanLine(std::vector<double> inverse_depth) : d_(std::move(inverse_depth)) {}

  /// Inverse depth of the continued surface per pixel, NaN where there is none.
  std::vector<double> hidden(double max_width, double focal_length) const
  {
    std::vector<double> result(d_.size(), std::nan(""));
    for (int left = 12; left + 12 < size(); ++left) {
      for (int right = left + 2; ends(left, 1) && right + 12 < size(); ++right) {
        if (!ends(right, -1)) {
          continue;
        }
        if ((right - left) / std::max(d_[left], d_[right]) > max_width * focal_length) {
          break;
        }
        if (bridge(left, right, result)) {
          break;
        }
      }
    }
    return result;
  }

private:
  struct Line
  {
    double at, slope;

    double operator()(int i) const { return at + slope * i; }
  };

  int size() const { return static_cast<int>(d_.size()); }

  std::vector<int> measured(int first) const
  {
    std::vector<int> pixels;
    for (int i = first; i < first + 12; ++i) {
      if (!std::isnan(d_[i])) {
        pixels.push_back(i);
      }
    }
    return pixels;
  }

  Line fit(const std::vector<int>& pixels) const
  {
    double mean_i = 0.0, mean_d = 0.0, variance = 0.0, covariance = 0.0;
    for (const int i : pixels) {
      mean_i += i / static_cast<double>(pixels.size());
      mean_d += d_[i] / static_cast<double>(pixels.size());
    }
    for (const int i : pixels) {
      variance += (i - mean_i) * (i - mean_i);
      covariance += (i - mean_i) * (d_[i] - mean_d);
    }
    return {mean_d - covariance / variance * mean_i, covariance / variance};
  }

  bool ends(int pixel, int direction) const
  {
    const std::vector<int> stretch = measured(direction > 0 ? pixel - 11 : pixel);
    if (stretch.size() < 9 || std::isnan(d_[pixel])) {
      return false;
    }
    const Line line = fit(stretch);
    bool ends = std::abs(d_[pixel] - line(pixel)) <= 0.006;
    for (int k = 1; k <= 3; ++k) {
      const int ahead = pixel + direction * k;
      ends = ends && !(d_[ahead] <= line(ahead) + 0.006 * (0.5 + 0.25 * k));
    }
    return ends;
  }

  bool bridge(int left, int right, std::vector<double>& hidden) const
  {
    std::vector<int> pixels = measured(left - 11);
    const std::vector<int> after = measured(right);
    pixels.insert(pixels.end(), after.begin(), after.end());
    const Line line = fit(pixels);
    if (std::any_of(pixels.begin(), pixels.end(), [&](int i) { return std::abs(d_[i] - line(i)) > 0.006; })) {
      return false;
    }
    for (int i = left + 1; i < right; ++i) {
      if (d_[i] < line(i) - 0.006) {
        return false;
      }
    }
    for (int i = left + 1; i < right; ++i) {
      if (!(std::abs(d_[i] - line(i)) <= 0.006)) {
        hidden[i] = std::isnan(hidden[i]) ? line(i) : std::min(hidden[i], line(i));
      }
    }
    return true;
  }

  std::vector<double> d_;
};

/// Depth of the hidden surface per pixel, NaN where there is none.
std::vector<double> plainHiddenDepth(const Cloud& cloud, double max_width)
{
  std::vector<double> depth(cloud.size(), std::nan(""));
  const auto goAlong = [&](std::size_t first, std::size_t step, std::size_t size, double focal_length) {
    std::vector<double> inverse_depth;
    for (std::size_t i = 0; i < size; ++i) {
      inverse_depth.push_back(1.0 / cloud.z[first + i * step]);
    }
    const std::vector<double> hidden = PlainScanLine(inverse_depth).hidden(max_width, focal_length);
    for (std::size_t i = 0; i < size; ++i) {
      depth[first + i * step] = std::fmax(depth[first + i * step], 1.0 / hidden[i]);
    }
  };
  for (std::size_t v = 0; v < cloud.height; v += 2) {
    goAlong(v * cloud.width, 1, cloud.width, kCamera.fx);
  }
  for (std::size_t u = 0; u < cloud.width; u += 2) {
    goAlong(u, cloud.width, cloud.height, kCamera.fy);
  }
  return depth;
}

bool sameBits(const Cloud& a, const Cloud& b)
{
  const auto same = [](const std::vector<float>& x, const std::vector<float>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](float p, float q) { return p == q || (std::isnan(p) && std::isnan(q)); });
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

TEST(HiddenSurfaces, AreThoseOfTheDefinitionWithEveryInstructionSet)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Cloud cloud = clutter(seed, 171, 117);
    std::string warning;
    const auto image = RangeImage::create(cloud, warning);
    const Cloud hidden = continueSurfaces(*image, kWidest);
    const std::vector<double> expected = plainHiddenDepth(cloud, kWidest);
    ASSERT_GT(measuredPoints(hidden), 300U) << "seed " << seed;
    for (std::size_t pixel = 0; pixel < cloud.size(); ++pixel) {
      ASSERT_EQ(hidden.measured(pixel), !std::isnan(expected[pixel])) << "seed " << seed << ", pixel " << pixel;
      if (hidden.measured(pixel)) {
        ASSERT_NEAR(hidden.z[pixel], expected[pixel], 1e-6 * expected[pixel]);  // rounded to single precision
      }
    }
    for (const std::string& instructions : instructionSets()) {
      useInstructionSet(instructions);
      EXPECT_TRUE(sameBits(continueSurfaces(*image, kWidest), hidden)) << instructions << ", seed " << seed;
    }
    useInstructionSet("");
  }
}

TEST(HiddenSurfaces, KeepNothingOfTheImageBefore)
{
  std::string warning;
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    HiddenSurfaces surfaces;
    for (const auto& [width, height] :
         {std::pair(171, 117), std::pair(171, 117), std::pair(90, 140), std::pair(64, 48)}) {
      for (const std::uint64_t seed : {1, 2}) {
        const Cloud cloud = clutter(seed, width, height);
        const auto image = RangeImage::create(cloud, warning);
        surfaces.update(*image, kWidest, team);
        EXPECT_TRUE(sameBits(surfaces.cloud(), continueSurfaces(*image, kWidest))) << width << ", " << threads;
      }
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
