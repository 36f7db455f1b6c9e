#pragma once

#include "core/cloud/range_image.h"
#include "grasp_affordances/config.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Whether a hand could reach around both sides of a pixel's surface: in one of four directions across the image, what
/// is seen on both sides, no farther apart than the hand can span, falls away from the pixel by at least a finger's
/// thickness, over three quarters of that thickness, or was not measured; the image's border is no such side. It holds
/// all over what a shell can enclose, and hardly anywhere on planes and inside corners; that a surface is enclosed it
/// does not tell.
bool fallsAwayOnBothSides(const RangeImage& image, std::size_t pixel, const HandGeometry& hand);

/// Measured points that fall away on both sides. The pixels of every other row and column are tried, one after another
/// of 64 lattices, each of which spreads evenly over the image; those after the one with which there are `enough`
/// points are left out. The seed decides on the order of the lattices.
std::vector<std::uint32_t> screenPoints(const RangeImage& image, const HandGeometry& hand, std::size_t enough,
                                        std::uint64_t seed);

/// The i-th of `config.samples` sampled points. Where there are as many candidates as samples, one drawn from the i-th
/// of equal parts of their list. Of fewer candidates each is drawn once. All other samples are drawn from all measured
/// points, uniformly. @return index of a point in the cloud
std::uint32_t samplePoint(const std::vector<std::uint32_t>& measured, const std::vector<std::uint32_t>& candidates,
                          const SamplingConfig& config, std::uint64_t i);

}  // namespace grasp_affordances
