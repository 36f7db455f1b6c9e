#include "simulation/polynomial_roots.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

/// Polynomial of degree N; coefficients in the order of ascending powers.
template <std::size_t N>
struct Polynomial
{
  std::array<double, N + 1> c;

  double operator()(double t) const
  {
    double value = c[N];
    for (std::size_t i = N; i-- > 0;)
      value = value * t + c[i];
    return value;
  }

  Polynomial<N - 1> derivative() const
  {
    Polynomial<N - 1> d;
    for (std::size_t i = 0; i < N; ++i)
      d.c[i] = static_cast<double>(i + 1) * c[i + 1];
    return d;
  }
};

/// Root of a polynomial that is monotone on [a, b] and has different signs at the ends. Newton's method; a step that
/// would leave the bracket is replaced by bisection.
template <std::size_t N>
double bracketedRoot(const Polynomial<N>& f, const Polynomial<N - 1>& slope, double a, double b)
{
  const bool rising = f(a) < 0.0;
  double t = 0.5 * (a + b);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double value = f(t);
    if (value == 0.0)
      return t;
    ((value < 0.0) == rising ? a : b) = t;
    double next = t - value / slope(t);
    if (!(next > a && next < b))
      next = 0.5 * (a + b);
    if (next == t || next == a || next == b)
      return next;
    t = next;
  }
  return t;
}

/// Writes the roots in [low, high] to `roots` and returns how many there are.
template <std::size_t N>
std::size_t findRoots(const Polynomial<N>& f, double low, double high, double* roots)
{
  if constexpr (N == 1) {
    *roots = -f.c[0] / f.c[1];
    return *roots >= low && *roots <= high ? 1 : 0;
  } else {
    const Polynomial<N - 1> slope = f.derivative();
    std::array<double, N + 1> ends;
    std::size_t last = findRoots(slope, low, high, &ends[1]) + 1;
    ends[0] = low;
    ends[last] = high;

    std::size_t count = 0;
    for (std::size_t i = 0; i < last; ++i) {
      if ((f(ends[i]) < 0.0) != (f(ends[i + 1]) < 0.0))
        roots[count++] = bracketedRoot(f, slope, ends[i], ends[i + 1]);
    }
    return count;
  }
}

}  // namespace

QuarticRoots depressedQuarticRoots(double p, double q, double s, double low, double high)
{
  QuarticRoots roots;
  roots.count = findRoots(Polynomial<4>{{s, q, p, 0.0, 1.0}}, low, high, roots.values.data());
  return roots;
}

}  // namespace grasp_affordances
