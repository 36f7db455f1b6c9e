#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What a depth camera measured, row-major; see Frame.
struct MeasuredImage
{
  MeasuredImage(std::uint32_t columns, std::uint32_t rows)
      : width(columns),
        height(rows),
        depth(std::size_t{columns} * rows, 0),
        parts(depth.size(), -1),
        surface_depth(depth.size(), std::nanf(""))
  {
  }

  /// Takes over what a pixel of an image shows.
  void copy(std::size_t to, const MeasuredImage& other, std::size_t from)
  {
    depth[to] = other.depth[from];
    parts[to] = other.parts[from];
    surface_depth[to] = other.surface_depth[from];
  }

  std::uint32_t width, height;
  std::vector<std::uint16_t> depth;  ///< mm; 0 where nothing was measured
  std::vector<std::int32_t> parts;
  std::vector<float> surface_depth;  ///< m
};

}  // namespace grasp_affordances
