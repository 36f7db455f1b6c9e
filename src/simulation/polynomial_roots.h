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

/// The roots of t^4 + p t^2 + q t + s in [low, high]. Roots where the polynomial touches zero without a change of sign
/// are left out.
///
/// A polynomial is monotone between the roots of its derivative, so that a change of sign brackets each root. The roots
/// of the derivative are found in the same way. Unlike the closed form, this does not lose digits to cancellation when
/// roots are close together.
QuarticRoots depressedQuarticRoots(double p, double q, double s, double low, double high);

}  // namespace grasp_affordances
