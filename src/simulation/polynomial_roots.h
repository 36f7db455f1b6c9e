#pragma once

#include <array>
#include <cstddef>

namespace grasp_affordances
{

/// Real roots in ascending order.
struct QuarticRoots
{
  std::array<double, 4> values{};
  std::size_t count = 0;

  const double* begin() const { return values.data(); }
  const double* end() const { return values.data() + count; }
};

/// The roots of t^4 + p t^2 + q t + s in [low, high], without those where the polynomial only touches zero.
///
/// Between the roots of its derivative a polynomial is monotone, so that a sign change brackets each root; the roots of
/// the derivative are found the same way. Unlike the closed form nothing cancels when roots are close together.
QuarticRoots depressedQuarticRoots(double p, double q, double s, double low, double high);

}  // namespace grasp_affordances
