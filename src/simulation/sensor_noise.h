#pragma once

#include "simulation/counter_random.h"

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Noise with mean 0 and variance 1, averaged over a window about each pixel, so that the correlation of pixels falls
/// linearly with their distance along rows and columns and ends where their windows part. Close to normal; never beyond
/// sqrt(3 n) for a window of n pixels.
///
/// @return row-major
std::vector<float> windowedNoise(std::uint64_t seed, RandomStream stream, std::uint32_t width, std::uint32_t height,
                                 std::uint32_t window_width, std::uint32_t window_height);

/// Normal noise with mean 0 and variance 1 in patches of a given size, for few pixels: drawn where it is asked for.
class PatchNoise
{
public:
  /// @param patch px, between the nodes of the grid on which independent numbers are drawn
  PatchNoise(std::uint64_t seed, RandomStream stream, double patch) : seed_(seed), stream_(stream), patch_(patch) {}

  double operator()(std::uint32_t column, std::uint32_t row) const;

private:
  std::uint64_t seed_;
  RandomStream stream_;
  double patch_;
};

}  // namespace grasp_affordances
