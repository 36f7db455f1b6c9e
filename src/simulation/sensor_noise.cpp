#include "simulation/sensor_noise.h"

#include "simulation/parallel_rows.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace grasp_affordances
{

std::vector<float> windowedNoise(std::uint64_t seed, RandomStream stream, std::uint32_t width, std::uint32_t height,
                                 std::uint32_t window_width, std::uint32_t window_height)
{
  // Sums over the window's columns. The image is larger by the window's rows.
  const std::uint32_t drawn_width = width + window_width - 1;
  const std::uint32_t drawn_height = height + window_height - 1;
  std::vector<float> row_sums(std::size_t{width} * drawn_height);
  forEachRow(drawn_height, [&](std::uint32_t row) {
    std::vector<float> drawn(drawn_width);
    CounterRandom random(seed, stream, row);
    for (float& number : drawn)
      number = static_cast<float>(random.uniform(-1.0, 1.0));
    float* sums = row_sums.data() + std::size_t{row} * width;
    for (std::uint32_t i = 0; i < window_width; ++i) {
      for (std::uint32_t column = 0; column < width; ++column)
        sums[column] += drawn[column + i];
    }
  });

  const float scale = std::sqrt(3.0F / static_cast<float>(window_width * window_height));  // uniform: variance 1/3
  std::vector<float> noise(std::size_t{width} * height);
  forEachRow(height, [&](std::uint32_t row) {
    float* sums = noise.data() + std::size_t{row} * width;
    for (std::uint32_t i = 0; i < window_height; ++i) {
      const float* row_sum = row_sums.data() + std::size_t{row + i} * width;
      for (std::uint32_t column = 0; column < width; ++column)
        sums[column] += scale * row_sum[column];
    }
  });
  return noise;
}

double exceededBy(double share)
{
  constexpr double kEnd = 6.5;  // no deviate is larger
  if (!(share > 0.0 && share < 1.0))
    return share > 0.0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  double low = -kEnd, high = kEnd;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > share ? low : high) = middle;
  }
  return std::round(100.0 * low) / 100.0;
}

double PatchNoise::operator()(std::uint32_t column, std::uint32_t row) const
{
  const double u = column / patch_;
  const double v = row / patch_;
  const double left = std::floor(u);
  const double top = std::floor(v);
  double sum = 0.0;
  double squared_weights = 0.0;
  for (const double y : {top, top + 1.0}) {
    for (const double x : {left, left + 1.0}) {
      const double weight = (1.0 - std::abs(u - x)) * (1.0 - std::abs(v - y));
      const auto node = (static_cast<std::uint64_t>(y) << 32U) + static_cast<std::uint64_t>(x);
      sum += weight * CounterRandom(seed_, stream_, node).normal();
      squared_weights += weight * weight;
    }
  }
  return sum / std::sqrt(squared_weights);
}

}  // namespace grasp_affordances
