#include "core/kernels/measured_kernels.h"
#include "core/kernels/moment_sums.h"
#include "core/kernels/nearest.h"
#include "core/kernels/ray_sums.h"
#include "grasp_affordances/cloud.h"

#include "support/instruction_sets.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

std::array<std::uint64_t, sizeof(RaySums) / sizeof(double)> bitsOf(const RaySums& sums)
{
  std::array<std::uint64_t, sizeof(RaySums) / sizeof(double)> bits;
  std::memcpy(bits.data(), &sums, sizeof(RaySums));
  return bits;
}

/// With count 0 either may be null, which memcmp must not be given.
bool sameBits(const float* a, const float* b, std::size_t count)
{
  return count == 0 || std::memcmp(a, b, count * sizeof(float)) == 0;
}

/// A third of the numbers are NaN.
std::vector<float> withGaps(std::size_t count, double low, double high, Random& random)
{
  std::vector<float> numbers(count);
  for (float& number : numbers) {
    number = random.uniform(0, 3) < 1 ? kNan : static_cast<float>(random.uniform(low, high));
  }
  return numbers;
}

struct Gathered
{
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> index;
};

/// Points on a grid, so that many are equally distant, or anywhere.
Gathered randomPoints(std::size_t count, bool on_grid, Random& random)
{
  Gathered points;
  for (std::size_t i = 0; i < count; ++i) {
    for (auto* coordinate : {&points.x, &points.y, &points.z}) {
      const double value = random.uniform(-4, 5);
      coordinate->push_back(static_cast<float>(on_grid ? std::floor(value) : value));
    }
    points.index.push_back(static_cast<std::uint32_t>(3 * i + 1));
  }
  return points;
}

float squaredDistance(const Gathered& points, std::size_t i, const float center[3])
{
  return squaredLength(points.x[i] - center[0], points.y[i] - center[1], points.z[i] - center[2]);
}

void expectNearest(const Gathered& points, std::size_t k)
{
  const float center[] = {0.5F, 0.0F, -1.0F};
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    order.emplace_back(squaredDistance(points, i, center), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < k; ++i) {
    expected.push_back(order[i].second);
  }
  std::sort(expected.begin(), expected.end());

  Gathered kept = points;
  std::vector<float> squared(points.x.size() + kGatherSlack);
  const float last = keepNearest({kept.x.data(), kept.y.data(), kept.z.data(), kept.index.data()}, points.x.size(),
                                 center, k, squared.data());
  EXPECT_EQ(last, order[k - 1].first);
  for (std::size_t i = 0; i < k; ++i) {
    ASSERT_EQ(kept.index[i], points.index[expected[i]]) << i << " of " << k << " of " << points.x.size();
    ASSERT_EQ(kept.x[i], points.x[expected[i]]);
    ASSERT_EQ(kept.y[i], points.y[expected[i]]);
    ASSERT_EQ(kept.z[i], points.z[expected[i]]);
  }
}

TEST(KeepNearest, AgreesWithSorting)
{
  forEachInstructionSet([] {
    Random random(1);
    for (const bool on_grid : {true, false}) {
      for (std::size_t count = 1; count < 60; ++count) {
        const Gathered points = randomPoints(count, on_grid, random);
        for (std::size_t k = 1; k <= count; k += 3) {
          expectNearest(points, k);
        }
        expectNearest(points, count);
      }
      expectNearest(randomPoints(900, on_grid, random), 500);
    }
  });
}

TEST(KeepNearest, OrdersDistancesOfAllMagnitudes)
{
  forEachInstructionSet([] {
    Random random(2);
    Gathered points = randomPoints(200, false, random);
    for (std::size_t i = 0; i < 200; ++i) {
      points.x[i] = static_cast<float>(std::pow(10.0, random.uniform(-30, 30)));  // some squares overflow
    }
    for (std::size_t k = 1; k <= 200; k += 7) {
      expectNearest(points, k);
    }
    const std::vector<float> same(50, 0.0F);
    expectNearest({std::vector<float>(50, 0.5F), same, std::vector<float>(50, -1.0F), std::vector<std::uint32_t>(50)},
                  20);
  });
}

TEST(BlankUnmeasured, AgreesWithTheCloud)
{
  const std::vector<float> special{0.0F, -0.0F, 1.0F, -0.5F, 1e-30F, 1e30F, kNan, kInfinity, -kInfinity, 1.8e19F};
  forEachInstructionSet([&] {
    Random random(3);
    for (std::size_t count = 0; count < 70; ++count) {
      Cloud expected;
      expected.reset(static_cast<std::uint32_t>(count), 1);
      std::array<std::vector<float>, 3> blanked;
      for (std::size_t i = 0; i < count; ++i) {
        for (auto& coordinate : blanked) {
          coordinate.push_back(special[static_cast<std::size_t>(random.uniform(0, special.size()))]);
        }
        expected.set(i, blanked[0][i], blanked[1][i], blanked[2][i]);
      }
      blankUnmeasured(blanked[0].data(), blanked[1].data(), blanked[2].data(), count);
      EXPECT_TRUE(sameBits(blanked[0].data(), expected.x.data(), count)) << count;
      EXPECT_TRUE(sameBits(blanked[1].data(), expected.y.data(), count)) << count;
      EXPECT_TRUE(sameBits(blanked[2].data(), expected.z.data(), count)) << count;
    }
  });
}

TEST(SplitPoints, CopiesAnyStepAndAddress)
{
  forEachInstructionSet([] {
    for (const std::size_t step : {12, 13, 16, 20, 32}) {
      for (const std::size_t count : {0, 1, 3, 4, 5, 9, 21}) {
        const std::size_t offset = step % 4;
        // Ends with the last point's z: a memory checker sees what is read beyond.
        std::vector<std::uint8_t> bytes(offset + (count == 0 ? 0 : (count - 1) * step + 12));
        for (std::size_t i = 0; i < count; ++i) {
          const float point[] = {1.0F + i, 100.0F + i, -1.0F * i};
          std::memcpy(&bytes[offset + i * step], point, sizeof(point));
        }
        std::array<std::vector<float>, 3> split;
        split.fill(std::vector<float>(count + 1, 7.0F));
        splitPoints(bytes.data() + offset, step, count, split[0].data(), split[1].data(), split[2].data());
        for (std::size_t i = 0; i < count; ++i) {
          EXPECT_EQ(split[0][i], 1.0F + i);
          EXPECT_EQ(split[1][i], 100.0F + i);
          EXPECT_EQ(split[2][i], -1.0F * i);
        }
        EXPECT_EQ(split[0][count], 7.0F);
        EXPECT_EQ(split[1][count], 7.0F);
        EXPECT_EQ(split[2][count], 7.0F);
      }
    }
  });
}

TEST(ListMeasured, FindsAllInOrder)
{
  forEachInstructionSet([] {
    Random random(4);
    for (std::size_t count = 0; count < 100; ++count) {
      const std::vector<float> numbers = withGaps(count, -1, 1, random);
      std::vector<std::uint32_t> expected;
      for (std::size_t i = 0; i < count; ++i) {
        if (!std::isnan(numbers[i])) {
          expected.push_back(static_cast<std::uint32_t>(i));
        }
      }
      const std::size_t room = countMeasured(numbers.data(), count);
      ASSERT_EQ(room, expected.size());
      constexpr std::uint32_t kUntouched = 12345;
      expected.push_back(kUntouched);
      std::vector<std::uint32_t> list(room + 1, kUntouched);
      listMeasured(numbers.data(), count, list.data(), room);
      EXPECT_EQ(list, expected) << count;
    }
  });
}

TEST(GatherMeasured, LeavesGapsOut)
{
  forEachInstructionSet([] {
    Random random(5);
    const std::vector<float> x = withGaps(200, -1, 1, random), y = withGaps(200, 0, 1, random), z(200, 2.0F);
    const float* const from[] = {x.data(), y.data(), z.data()};
    for (std::size_t count = 0; count < 70; ++count) {
      std::vector<std::uint32_t> index;
      std::vector<float> expected_x, expected_y;
      for (std::size_t i = 0; i < count; ++i) {
        index.push_back(static_cast<std::uint32_t>(random.uniform(0, 200)));
        if (!std::isnan(x[index.back()])) {
          expected_x.push_back(x[index.back()]);
          expected_y.push_back(y[index.back()]);
        }
      }
      std::array<std::vector<float>, 3> to;
      to.fill(std::vector<float>(count));
      float* const arrays[] = {to[0].data(), to[1].data(), to[2].data()};
      const std::size_t found = gatherMeasured(from, index.data(), count, arrays);
      ASSERT_EQ(found, expected_x.size());
      EXPECT_TRUE(sameBits(to[0].data(), expected_x.data(), found));
      EXPECT_TRUE(sameBits(to[1].data(), expected_y.data(), found));
    }
  });
}

constexpr std::size_t kParts = 8;
using Parts = std::array<double, kParts>;

double total(const Parts& p)
{
  return ((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7]));
}

/// Points before the sensor, a third of them not measured.
struct Rays
{
  std::vector<float> x, y, z;
  CloudRows rows;

  Rays(std::size_t width, std::size_t height, std::uint64_t seed)
  {
    Random random(seed);
    x = withGaps(width * height, -1, 1, random);
    for (const float px : x) {
      y.push_back(std::isnan(px) ? kNan : static_cast<float>(random.uniform(-1, 1)));
      z.push_back(std::isnan(px) ? kNan : static_cast<float>(random.uniform(0.5, 4)));
    }
    rows = {x.data(), y.data(), z.data(), width, 1, height};
  }
};

RaySums plainSums(const CloudRows& rows)
{
  std::array<Parts, 9> sums{};
  for (std::size_t v = rows.begin; v < rows.end; ++v) {
    Parts points{}, slopes{};
    for (std::size_t u = 0; u < rows.width; ++u) {
      const std::size_t i = v * rows.width + u, part = u % kParts;
      if (std::isnan(rows.z[i])) {
        continue;
      }
      const double inverse = 1.0 / static_cast<double>(rows.z[i]);
      const double slope_x = rows.x[i] * inverse, slope_y = rows.y[i] * inverse;
      points[part] += 1.0;
      slopes[part] += slope_y;
      sums[1][part] += u;
      sums[3][part] += slope_x;
      sums[4][part] += slope_x * slope_x;
      sums[5][part] += slope_x * u;
      sums[7][part] += slope_y * slope_y;
    }
    for (std::size_t part = 0; part < kParts; ++part) {
      sums[0][part] += points[part];
      sums[2][part] += points[part] * v;
      sums[6][part] += slopes[part];
      sums[8][part] += slopes[part] * v;
    }
  }
  return {total(sums[0]), total(sums[1]), total(sums[2]), total(sums[3]), total(sums[4]),
          total(sums[5]), total(sums[6]), total(sums[7]), total(sums[8])};
}

TEST(RaySums, AreThoseOfPlainLoops)
{
  forEachInstructionSet([] {
    for (const std::size_t width : {1, 5, 8, 13, 64, 77}) {
      const Rays rays(width, 9, width);
      RaySums sums;
      ASSERT_TRUE(sumRays(rays.rows, sums));
      EXPECT_EQ(bitsOf(sums), bitsOf(plainSums(rays.rows))) << width;
    }
  });
}

TEST(MaxResidual, IsThatOfAPlainLoop)
{
  forEachInstructionSet([] {
    for (const std::size_t width : {1, 5, 8, 13, 64, 77}) {
      const Rays rays(width, 9, width);
      const double f[] = {525.0, 520.0}, c[] = {31.5, 4.2};
      double expected = 0.0, residual = -1.0;
      for (std::size_t i = width; i < rays.z.size(); ++i) {
        if (!std::isnan(rays.z[i])) {
          const std::size_t u = i % width, v = i / width;
          const double inverse = 1.0 / static_cast<double>(rays.z[i]);
          const double du = f[0] * (rays.x[i] * inverse) + (c[0] - static_cast<double>(u));
          const double dv = f[1] * (rays.y[i] * inverse) + (c[1] - static_cast<double>(v));
          expected = std::max({expected, std::abs(du), std::abs(dv)});
        }
      }
      ASSERT_TRUE(maxResidual(rays.rows, f, c, residual));
      EXPECT_EQ(residual, expected) << width;
    }
  });
}

TEST(RaySums, NoticePointsThatAreNotBeforeTheSensor)
{
  forEachInstructionSet([] {
    for (const float depth : {0.0F, -1.0F}) {
      for (const std::size_t at : {13, 20, 38}) {
        Rays rays(13, 3, 1);
        rays.x[at] = rays.y[at] = 1.0F;
        rays.z[at] = depth;
        rays.rows.z = rays.z.data();
        const double f[] = {525.0, 525.0}, c[] = {6.0, 1.0};
        RaySums sums;
        double residual = 0.0;
        EXPECT_FALSE(sumRays(rays.rows, sums));
        EXPECT_FALSE(maxResidual(rays.rows, f, c, residual));
      }
    }
  });
}

TEST(MomentSums, AreTheSameUpToAnyDegree)
{
  forEachInstructionSet([] {
    Random random(6);
    const double center[] = {0.1, 0.2, 0.9};
    for (const std::size_t count : {0, 1, 7, 8, 9, 31, 32, 33, 100, 581}) {
      const Gathered points = randomPoints(count, false, random);
      const float* const coordinates[] = {points.x.data(), points.y.data(), points.z.data()};
      std::array<double, kMomentCount> all;
      sumMoments(coordinates, count, center, all.data());
      for (const int degree : {2, 3}) {
        std::array<double, kMomentCount> some;
        sumMoments(coordinates, count, center, some.data(), degree);
        EXPECT_EQ(std::memcmp(some.data(), all.data(), momentCount(degree) * sizeof(double)), 0)
            << count << " points, degree " << degree;
      }
    }
  });
}

}  // namespace
}  // namespace grasp_affordances::test
