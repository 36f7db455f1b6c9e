#include "simulation/counter_random.h"
#include "simulation/sensor_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

TEST(CounterRandom, GivesTheSameNumbersOnEveryPlatform)
{
  CounterRandom random(1, RandomStream::disparity, 2);
  EXPECT_EQ(random.bits(), 0xaef714253055051cu);
  EXPECT_EQ(random.normal(), -34806 * 0x1p-16);
  EXPECT_NE(CounterRandom(1, RandomStream::placement, 2).bits(), CounterRandom(1, RandomStream::disparity, 2).bits());
}

TEST(CounterRandom, NormalNumbersHaveTheirMoments)
{
  constexpr int n = 1000000;
  double sum = 0.0, squares = 0.0, neighbors = 0.0, previous = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = CounterRandom(7, RandomStream::disparity, i).normal();
    sum += x;
    squares += x * x;
    neighbors += x * previous;
    previous = x;
  }
  const double standard_error = 1.0 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0.0, 5.0 * standard_error);
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0) * standard_error);
  EXPECT_NEAR(neighbors / n, 0.0, 5.0 * standard_error);
}

TEST(WindowedNoise, IsCorrelatedWithinItsWindowAlone)
{
  constexpr int width = 640, height = 480;
  const std::vector<float> noise = windowedNoise(3, RandomStream::disparity, width, height, 9, 3);
  const auto correlation = [&](int columns, int rows) {
    double sum = 0.0;
    for (int row = 0; row + rows < height; ++row) {
      for (int column = 0; column + columns < width; ++column)
        sum += noise[row * width + column] * noise[(row + rows) * width + column + columns];
    }
    return sum / ((width - columns) * (height - rows));
  };
  // So many numbers are as good as independent: windows of which each shares its noise with a part of the others.
  const double standard_error = std::sqrt(6.04 * 2.11 / (width * height));
  for (const int columns : {0, 1, 2, 4, 8, 9, 12, 40}) {
    for (const int rows : {0, 1, 2, 3, 10}) {
      const double shared = std::max(0.0, 1.0 - columns / 9.0) * std::max(0.0, 1.0 - rows / 3.0);
      EXPECT_NEAR(correlation(columns, rows), shared, 5.0 * std::sqrt(2.0) * standard_error)
          << columns << " columns, " << rows << " rows";
    }
  }
}

TEST(PatchNoise, HasUnitVarianceEverywhereAndPatchesOfItsSize)
{
  constexpr int n = 40000;
  const double patch = 6.0;
  for (const auto& [column, row] : {std::pair(0u, 0u), std::pair(3u, 3u), std::pair(2u, 5u)}) {
    double squares = 0.0, near = 0.0, far = 0.0;
    for (int seed = 0; seed < n; ++seed) {
      const PatchNoise noise(seed, RandomStream::reflection, patch);
      const double here = noise(column, row);
      squares += here * here;
      near += here * noise(column + 1, row);
      far += here * noise(column + 12, row);
    }
    EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
    EXPECT_GT(near / n, 0.9);
    EXPECT_NEAR(far / n, 0.0, 5.0 / std::sqrt(n));
  }
}

}  // namespace
}  // namespace grasp_affordances
