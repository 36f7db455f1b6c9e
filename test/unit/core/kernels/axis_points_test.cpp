#include "core/kernels/axis_points.h"
#include "core/cloud/range_image.h"
#include "core/kernels/instruction_sets.h"
#include "core/kernels/pixel_lookup.h"
#include "core/shell/axis_slices.h"
#include "support/points.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// With every instruction set that this processor has.
class AxisPointKernels : public testing::TestWithParam<std::string>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(""); }
};

INSTANTIATE_TEST_SUITE_P(InstructionSets, AxisPointKernels, testing::ValuesIn(instructionSets()),
                         [](const auto& info) { return info.param; });

/// Points about an axis, a share of which was not measured.
Cloud scatteredPoints(std::size_t count, const Eigen::Vector3d& center, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  cloud.reset(static_cast<std::uint32_t>(count), 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f p = (center + 0.08 * random.uniform(0.0, 1.0) * random.direction()).cast<float>();
    if (random.uniform(0.0, 1.0) > 0.1) {
      cloud.set(i, p.x(), p.y(), p.z());
    }
  }
  return cloud;
}

struct Frame
{
  Eigen::Vector3d origin, axis, first, second;

  Frame(Eigen::Vector3d at, Eigen::Vector3d along)
      : origin(std::move(at)), axis(std::move(along)), first(axis.unitOrthogonal()), second(axis.cross(first))
  {
  }
  AxisFrame plain() const
  {
    AxisFrame frame;
    Eigen::Map<Eigen::Vector3d>(frame.origin) = origin;
    Eigen::Map<Eigen::Vector3d>(frame.axis) = axis;
    Eigen::Map<Eigen::Vector3d>(frame.first) = first;
    Eigen::Map<Eigen::Vector3d>(frame.second) = second;
    return frame;
  }
  /// Along the axis, and across.
  Eigen::Vector3d place(const Eigen::Vector3f& point) const
  {
    const Eigen::Vector3d p = point.cast<double>() - origin;
    return {p.dot(axis), p.dot(first), p.dot(second)};
  }
};

TEST_P(AxisPointKernels, ChooseThePointsOfACylinderInTheirOrder)
{
  const Frame frame({0.2, -0.1, 0.9}, Eigen::Vector3d(0.3, 0.8, -0.5).normalized());
  const double radius = 0.03, begin = -0.02, end = 0.03, rounding = 1e-6;
  CylinderBounds bounds{};
  Eigen::Map<Eigen::Vector3f>(bounds.origin) = frame.origin.cast<float>();
  Eigen::Map<Eigen::Vector3f>(bounds.axis) = frame.axis.cast<float>();
  bounds.begin = static_cast<float>(begin);
  bounds.end = static_cast<float>(end);
  bounds.squared_radius = static_cast<float>(radius * radius);
  bounds.farthest = 2.0F;
  for (const std::size_t count : {0U, 1U, 7U, 16U, 33U, 1000U}) {
    const Cloud cloud = scatteredPoints(count, frame.origin, count);
    const float* const points[] = {cloud.x.data(), cloud.y.data(), cloud.z.data()};
    std::vector<PixelSpan> spans;
    for (std::size_t i = 0; i < count; i += 21) {
      spans.push_back({i, std::min(count, i + 19)});
    }
    std::array<std::vector<float>, 4> room;
    room.fill(std::vector<float>(count + kChoiceSlack));
    const ChosenPoints chosen{room[0].data(), room[1].data(), room[2].data(), room[3].data()};
    const std::size_t size = chooseInCylinder(points, count, spans.data(), spans.size(), bounds, chosen);

    std::size_t next = 0;
    for (const PixelSpan& span : spans) {
      for (std::size_t i = span.begin; i < span.end; ++i) {
        const Eigen::Vector3d place = frame.place(cloud.point(i));
        const double radial = place.tail<2>().norm();
        const double slack = std::max({radial - radius, begin - place[0], place[0] - end});  // NaN: not measured
        const bool was_chosen = next < size && chosen.x[next] == cloud.x[i] && chosen.z[next] == cloud.z[i];
        if (was_chosen) {
          EXPECT_NEAR(chosen.along[next], place[0], rounding);
          ++next;
        }
        EXPECT_TRUE(was_chosen ? slack < rounding : !(slack < -rounding)) << i << " of " << count;
      }
    }
    EXPECT_EQ(next, size);
  }
}

/// Brute force.
ShellCounts countedOneByOne(const std::vector<Eigen::Vector3d>& places, const ShellBounds& shell)
{
  ShellCounts counts;
  for (const Eigen::Vector3d& place : places) {
    const double x = place[1] - shell.center[0], y = place[2] - shell.center[1], squared = x * x + y * y;
    if (place[0] >= shell.begin && place[0] <= shell.end) {
      counts.short_of_filled += squared <= shell.squared_filled ? 1 : 0;
      counts.inside += squared <= shell.squared_inner ? 1 : 0;
      counts.up_to_outer += squared <= shell.squared_outer ? 1 : 0;
    }
  }
  return counts;
}

/// Points placed along an axis by the kernel, and the same one by one.
struct PlacedPoints
{
  PlacedPoints(std::size_t count, double begin, double end)
  {
    const Frame frame({0.2, -0.1, 0.9}, Eigen::Vector3d(-0.3, 0.1, 0.7).normalized());
    const Cloud cloud = scatteredPoints(count, frame.origin, 5 + count);
    std::array<std::vector<float>, 3> points;
    for (std::size_t i = 0; i < count; ++i) {
      if (!cloud.measured(i)) {
        continue;
      }
      points[0].push_back(cloud.x[i]);
      points[1].push_back(cloud.y[i]);
      points[2].push_back(cloud.z[i]);
      const Eigen::Vector3d place = frame.place(cloud.point(i));
      if (place[0] >= begin && place[0] < end) {
        places.push_back(place);
      }
    }
    const std::size_t measured = points[0].size();
    for (auto& coordinate : points) {
      coordinate.resize(measured + kAxisPointGroup, std::nanf(""));
    }
    for (auto* coordinate : {&along, &first, &second}) {
      coordinate->resize(measured + kAxisPointGroup);
    }
    const float* const arrays[] = {points[0].data(), points[1].data(), points[2].data()};
    size = takeSlice(arrays, measured, frame.plain(), begin, end, {along.data(), first.data(), second.data()});
  }
  AxisPoints plain() const { return {along.data(), first.data(), second.data(), size}; }

  std::vector<Eigen::Vector3d> places;
  std::vector<double> along, first, second;
  std::size_t size;
};

TEST_P(AxisPointKernels, CountAndSumThePointsOfAShell)
{
  for (const std::size_t count : {0U, 1U, 8U, 9U, 100U, 2000U}) {
    const PlacedPoints points(count, -0.03, 0.02);
    ASSERT_EQ(points.size % kAxisPointGroup, 0U);
    for (const double filled : {-1.0, 0.0001}) {
      const ShellBounds shell{{0.004, -0.003}, -0.025, 0.01, filled, 0.0004, 0.0008, 0.05};
      const ShellCounts counts = countPoints(points.plain(), shell);
      const ShellCounts expected = countedOneByOne(points.places, shell);
      EXPECT_EQ(counts.short_of_filled, expected.short_of_filled);
      EXPECT_EQ(counts.inside, expected.inside);
      EXPECT_EQ(counts.up_to_outer, expected.up_to_outer);

      AlongRange range{kInfinity, -kInfinity};
      std::array<double, kPlaneMoments> sums{};
      for (const Eigen::Vector3d& p : points.places) {
        if (countedOneByOne({p}, shell).inside == 0) {
          continue;
        }
        range.first = std::min(range.first, p[0]);
        range.last = std::max(range.last, p[0]);
        const double x = p[1], y = p[2], s = x * x + y * y;
        const double terms[] = {1.0, x, y, x * x, x * y, y * y, s * x, s * y, s * s};
        for (int m = 0; m < kPlaneMoments; ++m) {
          sums[m] += terms[m];
        }
      }
      const AlongRange measured = insideRange(points.plain(), shell);
      constexpr double kRounding = 1e-15;  // of coordinates below 0.1 m
      EXPECT_TRUE(measured.first == range.first || std::abs(measured.first - range.first) < kRounding);
      EXPECT_TRUE(measured.last == range.last || std::abs(measured.last - range.last) < kRounding);
      PlaneMomentParts parts;
      addMoments(points.plain(), shell, parts);
      for (int m = 0; m < kPlaneMoments; ++m) {
        double sum = 0.0;
        for (const double part : parts.of[m]) {
          sum += part;
        }
        EXPECT_NEAR(sum, sums[m], 1e-12 * (1.0 + std::abs(sums[m]))) << "moment " << m;
      }
    }
  }
}

/// An image of a rough surface that falls away from the sensor, a share of
/// which was not measured.
class RoughImage
{
public:
  explicit RoughImage(double nearest)
  {
    Random random(7);
    cloud_.reset(160, 120);
    cloud_.intrinsics = PinholeIntrinsics{260.0, -240.0, 81.3, 58.1};
    const PinholeIntrinsics& camera = *cloud_.intrinsics;
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      const std::size_t column = i % 160, row = i / 160;
      const auto u = static_cast<double>(column), v = static_cast<double>(row);
      const double z = nearest + 0.0008 * u + random.uniform(0.0, 0.05);
      if (random.uniform(0.0, 1.0) > 0.1) {
        cloud_.set(i, static_cast<float>((u - camera.cx) / camera.fx * z),
                   static_cast<float>((v - camera.cy) / camera.fy * z), static_cast<float>(z));
      }
    }
    std::string warning;
    image_ = RangeImage::create(cloud_, warning);
  }
  RoughImage(const RoughImage&) = delete;
  RoughImage& operator=(const RoughImage&) = delete;

  const RangeImage& image() const { return *image_; }

private:
  Cloud cloud_;
  std::optional<RangeImage> image_;
};

TEST_P(AxisPointKernels, LookUpThePixelsOfTheRangeImage)
{
  const RoughImage rough(0.5);
  const RangeImage& image = rough.image();
  const PinholeIntrinsics& camera = image.intrinsics();
  constexpr std::size_t kPoints = 800;
  std::array<std::vector<double>, 3> points;
  Random random(9);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double z = random.uniform(-0.2, 1.0);
    points[0].push_back(0.4 * z * random.uniform(-1.0, 1.0));
    points[1].push_back(0.4 * z * random.uniform(-1.0, 1.0));
    points[2].push_back(i % 50 == 0 ? 0.0 : z);
  }
  const double* const arrays[] = {points[0].data(), points[1].data(), points[2].data()};
  std::vector<double> pixels(kPoints);
  lookUpPixels({camera.fx, camera.fy, camera.cx, camera.cy, 160.0, 120.0}, arrays, kPoints, pixels.data());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const auto pixel = image.pixel({points[0][i], points[1][i], points[2][i]});
    EXPECT_EQ(pixels[i], pixel ? static_cast<double>(*pixel) : -1.0);
    seen += pixel ? 1 : 0;
  }
  EXPECT_GT(seen, kPoints / 4);
}

std::vector<double> acrossAxis(const AxisPoints& points)
{
  return {points.first, points.first + points.size};
}

/// Slices hold exactly the points that a look at each point of the cloud finds
/// in them.
TEST_P(AxisPointKernels, GatherTheSlicesOfAnyAxis)
{
  Random random(11);
  AxisSlices axis_slices, scalar_slices;
  std::size_t points_seen = 0;
  for (const double nearest : {0.03, 0.2, 0.6}) {
    const RoughImage rough(nearest);
    const Cloud& cloud = rough.image().cloud();
    const auto window = makeWindowSearch(rough.image(), cloud.size());
    const auto tree = makeTreeSearch(cloud);
    for (int i = 0; i < 12; ++i) {
      const auto pixel = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(cloud.size())));
      const Eigen::Vector3d center =
          cloud.measured(pixel) ? Eigen::Vector3d(cloud.point(pixel).cast<double>()) : Eigen::Vector3d(0, 0, nearest);
      // Also straight along the view, and along rows and columns.
      const Eigen::Vector3d axis = i < 3 ? Eigen::Vector3d(Eigen::Vector3d::Unit(i))
                                         : (i == 3 ? Eigen::Vector3d(center.normalized()) : random.direction());
      const Frame frame(center, axis);
      Slices slices;
      slices.count = i % 4 == 0 ? 1 : 17;
      slices.thickness = slices.count == 1 ? 0.03 : 0.004;
      slices.begin = -slices.thickness * static_cast<double>(slices.count) / 2;
      for (const NeighborhoodSearch* search : {window.get(), tree.get()}) {
        axis_slices.start(search, frame.plain(), slices, 0.034);
        for (const double reach : {0.02, 0.034}) {  // the second time, farther out
          ShellBounds shell{{0.0, 0.0}, -1.0, 1.0, -1.0, 0.0001, reach * reach, reach};
          for (std::size_t slice = 0; slice < slices.count; ++slice) {
            std::vector<Eigen::Vector3d> places;
            for (std::size_t p = 0; p < cloud.size(); ++p) {
              const Eigen::Vector3d place = frame.place(cloud.point(p));
              if (place[0] >= slices.beginOf(slice) && place[0] < slices.endOf(slice)) {
                places.push_back(place);
              }
            }
            const ShellCounts expected = countedOneByOne(places, shell);
            const ShellCounts counts = countPoints(axis_slices.get(slice, reach), shell);
            ASSERT_EQ(counts.up_to_outer, expected.up_to_outer) << "slice " << slice << " of axis " << i;
            ASSERT_EQ(counts.inside, expected.inside);
            points_seen += counts.up_to_outer;
          }
          scalar_slices.start(search, frame.plain(), slices, 0.034);
          for (std::size_t slice = 0; slice < slices.count; ++slice) {
            const std::vector<double> points = acrossAxis(axis_slices.get(slice, reach));
            useInstructionSet(instructionSets().back());
            ASSERT_EQ(acrossAxis(scalar_slices.get(slice, reach)), points) << "the same points in the same places";
            useInstructionSet(GetParam());
          }
        }
      }
    }
  }
  EXPECT_GT(points_seen, 10000U);
}

}  // namespace
}  // namespace grasp_affordances::test
