#include "simulation/driver_filters.h"

#include "simulation/parallel_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace grasp_affordances
{

void fillHoles(std::uint32_t widest, MeasuredImage& image)
{
  if (widest == 0)
    return;
  forEachRow(image.height, [&](std::uint32_t row) {
    const std::size_t begin = std::size_t{row} * image.width, end = begin + image.width;
    for (std::size_t left = begin; left < end;) {  // a measured pixel before a hole
      std::size_t right = left + 1;
      while (right < end && image.depth[right] == 0)
        ++right;
      if (right < end && image.depth[left] != 0 && right - left - 1 <= widest) {
        const std::size_t farther = image.depth[left] > image.depth[right] ? left : right;
        for (std::size_t hole = left + 1; hole < right; ++hole)
          image.copy(hole, image, farther);
      }
      left = right;
    }
  });
}

void smoothDepth(std::uint32_t radius, double step, MeasuredImage& image)
{
  if (radius == 0)
    return;
  const std::vector<std::uint16_t> before = image.depth;
  const auto largest = static_cast<int>(std::lround(step));
  const int reach = static_cast<int>(radius), width = static_cast<int>(image.width),
            height = static_cast<int>(image.height);
  forEachRow(height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * image.width + column;
      const int middle = before[i];
      if (middle == 0)
        continue;
      int sum = middle, count = 1;  // the pixel itself, which is not visited again
      for (int v = std::max(0, row - reach); v <= std::min(height - 1, row + reach); ++v) {
        for (int u = std::max(0, column - reach); u <= std::min(width - 1, column + reach); ++u) {
          const int other = before[static_cast<std::size_t>(v) * image.width + u];
          const bool itself = v == row && u == column;
          const bool alike = other != 0 && !itself && std::abs(other - middle) <= largest;
          sum += alike ? other : 0;
          count += alike ? 1 : 0;
        }
      }
      image.depth[i] = static_cast<std::uint16_t>((sum + count / 2) / count);
    }
  });
}

}  // namespace grasp_affordances
