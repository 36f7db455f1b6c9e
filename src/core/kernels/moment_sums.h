#pragma once

#include <cstddef>

namespace grasp_affordances
{

constexpr int kMomentCount = 35;

/// Place of x^i y^j z^k among the moments: graded by degree, then by k, then by j.
constexpr int momentIndex(int i, int j, int k)
{
  const int degree = i + j + k;
  const int before = degree * (degree + 1) * (degree + 2) / 6;
  return before + k * (2 * degree + 3 - k) / 2 + j;
}
static_assert(momentIndex(0, 0, 4) == kMomentCount - 1, "moments are numbered without gaps");

/// Number of moments up to a degree.
constexpr int momentCount(int degree)
{
  return momentIndex(0, 0, degree) + 1;
}

/// Sums all monomials of degree at most `degree` (2, 3 or 4) over `count` points, in coordinates from a centre and in
/// double precision. A moment has the same bits for every `degree`.
/// @param coordinates  of the points, three arrays
/// @param center  three coordinates
/// @param moments  momentCount(degree) of them, by momentIndex; out
void sumMoments(const float* const coordinates[3], std::size_t count, const double center[3], double* moments,
                int degree = 4);

}  // namespace grasp_affordances
