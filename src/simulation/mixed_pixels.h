#pragma once

#include "simulation/disparity_image.h"
#include "simulation/measured_image.h"

#include <cstdint>

namespace grasp_affordances
{

/// Depth at edges that belongs to neither surface. Only pixels that were measured change, and what part they show
/// stays.
struct MixedPixels
{
  std::uint32_t ramp = 1;     ///< px, width over which depth passes from one surface to the other; 1: at once
  double flying_share = 0.0;  ///< of the pixels next to an edge: depth is anywhere between the two surfaces

  /// @param edges true disparities, in which depth edges are found
  void apply(const DisparityImage& edges, std::uint64_t seed, MeasuredImage& image) const;
};

}  // namespace grasp_affordances
