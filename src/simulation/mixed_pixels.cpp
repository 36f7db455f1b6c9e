#include "simulation/mixed_pixels.h"

#include "simulation/counter_random.h"
#include "simulation/parallel_rows.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// What was measured in a square.
struct Depths
{
  std::uint32_t sum = 0, count = 0;
  std::uint16_t nearest = 0xffff, farthest = 0;
};

/// @param before,after how far the square reaches from the pixel
Depths depthsAround(const MeasuredImage& image, const std::vector<std::uint16_t>& depth, Pixel p, int before, int after)
{
  const int last_column = static_cast<int>(image.width) - 1, last_row = static_cast<int>(image.height) - 1;
  Depths depths;
  for (int row = std::max(0, p.row - before); row <= std::min(last_row, p.row + after); ++row) {
    for (int column = std::max(0, p.column - before); column <= std::min(last_column, p.column + after); ++column) {
      const std::uint16_t measured = depth[static_cast<std::size_t>(row) * image.width + column];
      if (measured == 0)
        continue;
      depths.sum += measured;
      ++depths.count;
      depths.nearest = std::min(depths.nearest, measured);
      depths.farthest = std::max(depths.farthest, measured);
    }
  }
  return depths;
}

}  // namespace

void MixedPixels::apply(const DisparityImage& edges, std::uint64_t seed, MeasuredImage& image) const
{
  if (ramp < 2 && flying_share == 0.0)
    return;
  const std::vector<std::uint16_t> sharp = image.depth;
  const int before = static_cast<int>(ramp) / 2, after = (static_cast<int>(ramp) - 1) / 2;
  forEachRow(static_cast<int>(image.height), [&](int row) {
    CounterRandom random(seed, RandomStream::flying, static_cast<std::uint64_t>(row));
    for (int column = 0; column < static_cast<int>(image.width); ++column) {
      const Pixel p{column, row};
      const std::size_t i = edges.index(p);
      if (sharp[i] == 0 || !edges.edgeWithin(std::max(1, before), p))
        continue;
      if (flying_share > 0.0 && edges.edgeWithin(1, p) && random.uniform() < flying_share) {
        const Depths around = depthsAround(image, sharp, p, 1, 1);
        image.depth[i] =
            static_cast<std::uint16_t>(around.nearest + random.uniform() * (around.farthest - around.nearest));
      } else if (ramp > 1) {
        const Depths around = depthsAround(image, sharp, p, before, after);
        image.depth[i] = static_cast<std::uint16_t>((around.sum + around.count / 2) / around.count);
      }
    }
  });
}

}  // namespace grasp_affordances
