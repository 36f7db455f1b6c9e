// For kernel files, after core/kernels/simd_real.h: the smallest eigenpair of symmetric matrices, one in each lane. No
// include guard but a toggle: it is read once per instruction set.

#if defined(GRASP_AFFORDANCES_SIMD_SYMMETRIC_EIGEN) == defined(HWY_TARGET_TOGGLE)
#ifdef GRASP_AFFORDANCES_SIMD_SYMMETRIC_EIGEN
#undef GRASP_AFFORDANCES_SIMD_SYMMETRIC_EIGEN
#else
#define GRASP_AFFORDANCES_SIMD_SYMMETRIC_EIGEN
#endif

#include <array>
#include <limits>

// The loops have a small, fixed number of steps. Unrolled, their indices are constants and the matrices stay in the
// nearest memory, which is more than twice as fast.
#undef UNROLLED
#define UNROLLED _Pragma("GCC unroll 9")

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kUnknowns = 9;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

template <int Rows, int Columns>
using Matrix = std::array<std::array<Real, Columns>, Rows>;
template <int Size>
using Vector = std::array<Real, Size>;

/// A symmetric matrix as H T H', with tridiagonal T and orthogonal H, a product of Householder reflections.
struct Tridiagonal
{
  Vector<kUnknowns> diagonal;
  Vector<kUnknowns> below;  // the last is not used
  Real trace = Real(0.0);

  HWY_ATTR HWY_INLINE explicit Tridiagonal(Matrix<kUnknowns, kUnknowns>& A)
  {
    UNROLLED
    for (int k = 0; k < kUnknowns; ++k) {
      trace += A[k][k];
    }
    UNROLLED
    for (int k = 0; k + 2 < kUnknowns; ++k) {
      reflect(A, k);
      diagonal[k] = A[k][k];
    }
    diagonal[kUnknowns - 2] = A[kUnknowns - 2][kUnknowns - 2];
    diagonal[kUnknowns - 1] = A[kUnknowns - 1][kUnknowns - 1];
    below[kUnknowns - 2] = A[kUnknowns - 1][kUnknowns - 2];
  }

  /// x := H x
  HWY_ATTR HWY_INLINE void transformBack(Vector<kUnknowns>& x) const
  {
    UNROLLED
    for (int k = kUnknowns - 3; k >= 0; --k) {
      Real product(0.0);
      UNROLLED
      for (int i = k + 1; i < kUnknowns; ++i) {
        product += normal_[k][i] * x[i];
      }
      product = product * weight_[k];
      UNROLLED
      for (int i = k + 1; i < kUnknowns; ++i) {
        x[i] -= product * normal_[k][i];
      }
    }
  }

private:
  /// Reflects the part of column k below the diagonal onto its first entry.
  HWY_ATTR HWY_INLINE void reflect(Matrix<kUnknowns, kUnknowns>& A, int k)
  {
    Vector<kUnknowns>& v = normal_[k];
    Real squared_norm(0.0);
    UNROLLED
    for (int i = k + 1; i < kUnknowns; ++i) {
      v[i] = A[i][k];
      squared_norm += v[i] * v[i];
    }
    const Real norm = squareRoot(squared_norm);
    const Real first = v[k + 1];
    below[k] = choose(first < Real(0.0), norm, Real(0.0) - norm);
    v[k + 1] = first - below[k];
    const Real half_length = squared_norm + magnitude(first) * norm;  // v'v / 2
    weight_[k] = choose(Real(0.0) < half_length, Real(1.0) / half_length, Real(0.0));

    Vector<kUnknowns> p;
    Real product(0.0);
    UNROLLED
    for (int i = k + 1; i < kUnknowns; ++i) {
      Real sum(0.0);
      UNROLLED
      for (int j = k + 1; j < kUnknowns; ++j) {
        sum += (j <= i ? A[i][j] : A[j][i]) * v[j];
      }
      p[i] = sum * weight_[k];
      product += p[i] * v[i];
    }
    const Real share = Real(0.5) * product * weight_[k];
    UNROLLED
    for (int i = k + 1; i < kUnknowns; ++i) {
      p[i] -= share * v[i];
    }
    UNROLLED
    for (int i = k + 1; i < kUnknowns; ++i) {
      UNROLLED
      for (int j = k + 1; j <= i; ++j) {
        A[i][j] -= v[i] * p[j] + p[i] * v[j];
      }
    }
  }

  Matrix<kUnknowns, kUnknowns> normal_;  // row k: of the k-th reflection
  Vector<kUnknowns> weight_;
};

HWY_ATTR HWY_INLINE Real awayFromZero(Real pivot)
{
  constexpr double kTiny = 1e-150;
  return choose(magnitude(pivot) < Real(kTiny), Real(kTiny), pivot);
}

/// Number of eigenvalues below `shift`: negative pivots (Sylvester's law of inertia).
HWY_ATTR HWY_INLINE Real eigenvaluesBelow(const Tridiagonal& T, Real shift)
{
  Real count(0.0), pivot(1.0);
  UNROLLED
  for (int i = 0; i < kUnknowns; ++i) {
    const Real coupling = i > 0 ? T.below[i - 1] * T.below[i - 1] / pivot : Real();
    pivot = awayFromZero(T.diagonal[i] - shift - coupling);
    count += choose(pivot < Real(0.0), Real(1.0), Real(0.0));
  }
  return count;
}

/// Laguerre's iteration for the smallest eigenvalue, from below. It never passes the eigenvalue, and each step triples
/// the number of correct digits (J. H. Wilkinson, "The Algebraic Eigenvalue Problem", 1965, chapter 7). Below all
/// eigenvalues all pivots are positive.
struct SmallestEigenvalue
{
  Real value;
  Condition converged;

  HWY_ATTR HWY_INLINE SmallestEigenvalue(const Tridiagonal& T, Real rounding)
      : value(Real(0.0) - Real(8.0) * rounding), converged(rounding < rounding)
  {
    constexpr int kMostSteps = 24;
    const Real degree = static_cast<double>(kUnknowns);
    for (int step = 0; step < kMostSteps && !hn::AllTrue(Real::D(), converged); ++step) {
      // Sums over the eigenvalues of 1 / (value - eigenvalue) and of its square: first and second derivative of the
      // logarithm of the characteristic polynomial, which is the product of the pivots.
      Real first(0.0), second(0.0), smallest_pivot = std::numeric_limits<double>::infinity();
      Real inverse(0.0), slope(0.0), bend(0.0);  // of the last pivot: 1 / pivot, pivot' / pivot, pivot'' / pivot
      UNROLLED
      for (int i = 0; i < kUnknowns; ++i) {
        Real pivot = T.diagonal[i] - value;
        Real new_slope(-1.0), new_bend(0.0);
        if (i > 0) {
          const Real coupling = T.below[i - 1] * T.below[i - 1] * inverse;
          pivot -= coupling;
          new_slope += coupling * slope;
          new_bend = coupling * (bend - Real(2.0) * slope * slope);
        }
        smallest_pivot = smaller(pivot, smallest_pivot);
        inverse = Real(1.0) / pivot;
        slope = new_slope * inverse;
        bend = new_bend * inverse;
        first += slope;
        second += slope * slope - bend;
      }
      const Real root = squareRoot(larger(Real(0.0), (degree - Real(1.0)) * (degree * second - first * first)));
      const Real advance = degree / (root - first);
      // Where a pivot is not positive, the last step has reached the eigenvalue to rounding.
      const Condition open = hn::And(hn::Not(converged), Real(0.0) < smallest_pivot);
      value = choose(open, value + advance, value);
      converged = hn::Or(hn::Not(open), advance < rounding);
    }
  }
};

/// The unit eigenvector of an eigenvalue, from the twisted factorization whose pivot is smallest (K. V. Fernando, "On
/// computing an eigenvector of a tridiagonal matrix", SIAM J. Matrix Anal. Appl. 18, 1997).
HWY_ATTR HWY_INLINE Vector<kUnknowns> eigenvector(const Tridiagonal& T, Real eigenvalue)
{
  Vector<kUnknowns> forward, backward;  // pivots
  UNROLLED
  for (int i = 0; i < kUnknowns; ++i) {
    const Real coupling = i > 0 ? T.below[i - 1] * T.below[i - 1] / forward[i - 1] : Real();
    forward[i] = awayFromZero(T.diagonal[i] - eigenvalue - coupling);
  }
  UNROLLED
  for (int i = kUnknowns - 1; i >= 0; --i) {
    const Real coupling = i + 1 < kUnknowns ? T.below[i] * T.below[i] / backward[i + 1] : Real();
    backward[i] = awayFromZero(T.diagonal[i] - eigenvalue - coupling);
  }
  Real smallest = std::numeric_limits<double>::infinity(), twist(0.0);
  UNROLLED
  for (int i = 0; i < kUnknowns; ++i) {
    const Real pivot = magnitude(forward[i] + backward[i] - (T.diagonal[i] - eigenvalue));
    const Condition better = pivot < smallest;
    smallest = choose(better, pivot, smallest);
    twist = choose(better, Real(static_cast<double>(i)), twist);
  }
  Vector<kUnknowns> x;
  Real squared_norm(0.0);
  UNROLLED
  for (int i = 0; i < kUnknowns; ++i) {
    const Real place = static_cast<double>(i);
    x[i] = choose(magnitude(twist - place) < Real(0.5), Real(1.0), Real());
    if (i > 0) {
      x[i] = choose(twist < place, Real(0.0) - T.below[i - 1] / backward[i] * x[i - 1], x[i]);
    }
  }
  UNROLLED
  for (int i = kUnknowns - 2; i >= 0; --i) {
    const Real place = static_cast<double>(i);
    x[i] = choose(place < twist, Real(0.0) - T.below[i] / forward[i] * x[i + 1], x[i]);
  }
  for (const Real& entry : x) {
    squared_norm += entry * entry;
  }
  const Real scale = Real(1.0) / squareRoot(squared_norm);
  for (Real& entry : x) {
    entry = entry * scale;
  }
  return x;
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#endif
