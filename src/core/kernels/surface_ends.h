#pragma once

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// So many rows or columns of a range image are looked at together. Their values are interleaved: that of line k at
/// pixel i has the number i * kScanLines + k.
constexpr std::size_t kScanLines = 8;

constexpr int kStretch = 12;                 // number of pixels to which the line of a surface is fitted
constexpr double kFewestMeasured = 9.0;      // so many of them must be measured
constexpr double kSurfaceTolerance = 0.006;  // 1/m: two disparity steps of a structured-light sensor

/// Number of sums for the regression of a line, over pixels i with inverse depth d: of 1, i, i^2, d and i d.
constexpr std::size_t kLineSums = 5;

/// Finds the pixels at which surfaces end in scan lines. There the inverse depths of a stretch before (or after) the
/// pixel lie on a line, and the next pixels after (or before) it are nearer than that line, or missing.
/// @param depth  of `size` pixels of the lines (m; NaN: not measured)
/// @param inverse_depth  of the same pixels (1/m), out
/// @param sums  over all measured pixels before each of 0, ..., size, out: sum m of line k before pixel i has the
/// number
/// ((i * kLineSums) + m) * kScanLines + k
/// @param last  out: bit k of number i tells whether a surface of line k ends at pixel i
/// @param first  out: bit k of number i tells whether a surface of line k begins at pixel i
void findSurfaceEnds(const float* depth, std::size_t size, double* inverse_depth, double* sums, std::uint8_t* last,
                     std::uint8_t* first);

}  // namespace grasp_affordances
