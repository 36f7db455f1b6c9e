#pragma once

#include "simulation/counter_random.h"

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Noise with mean 0 and variance 1, averaged over a window about each pixel. The correlation of two pixels decreases
/// linearly with their distance along rows and columns; it is 0 if their windows do not overlap. The distribution is
/// close to normal. No value exceeds sqrt(3 n) for a window of n pixels.
///
/// @return row-major
std::vector<float> windowedNoise(std::uint64_t seed, RandomStream stream, std::uint32_t width, std::uint32_t height,
                                 std::uint32_t window_width, std::uint32_t window_height);

/// The value that a share of all normal deviates exceeds, rounded to a hundredth: the same on every platform. Infinite
/// for a share of 0, or, with a minus, of 1.
double exceededBy(double share);

/// Normal noise with mean 0 and variance 1, in patches of a given size. Values are computed on request, which is fast
/// if few pixels need them.
class PatchNoise
{
public:
  /// @param patch px, spacing of the grid on which independent numbers are drawn
  PatchNoise(std::uint64_t seed, RandomStream stream, double patch) : seed_(seed), stream_(stream), patch_(patch) {}

  double operator()(std::uint32_t column, std::uint32_t row) const;

private:
  std::uint64_t seed_;
  RandomStream stream_;
  double patch_;
};

}  // namespace grasp_affordances
