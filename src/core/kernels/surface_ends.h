#pragma once

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// Rows or columns of a range image that are looked at together. Their values are interleaved: that of line k at pixel
/// i is number i * kScanLines + k.
constexpr std::size_t kScanLines = 8;

constexpr int kStretch = 12;                 // pixels that show which way a surface goes
constexpr double kFewestMeasured = 9.0;      // of them
constexpr double kSurfaceTolerance = 0.006;  // 1/m: two disparity steps of a structured-light sensor

/// The sums over pixels i with inverse depth d of a line's regression: of 1, i, i^2, d and i d.
constexpr std::size_t kLineSums = 5;

/// Where surfaces end in scan lines: pixels up to which, or from which on, the inverse depths of a stretch lie on a
/// line, and beyond which the next are nearer or missing.
/// @param depth of `size` pixels of the lines (m; NaN: not measured).
/// @param inverse_depth of the same pixels (1/m).
/// @param sums over all measured pixels before each of 0, ..., size: number ((i * kLineSums) + m) * kScanLines + k.
/// @param last bit k of number i tells whether a surface of line k ends at pixel i.
/// @param first as `last`, for surfaces that begin there.
void findSurfaceEnds(const float* depth, std::size_t size, double* inverse_depth, double* sums, std::uint8_t* last,
                     std::uint8_t* first);

}  // namespace grasp_affordances
