#include "core/quadric_fits.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/quadric_fits.cpp"
#include "core/simd.h"
#include "core/simd_real.h"

// Loops run over a fixed few: unrolled, their indices are constants, and the matrices stay close: more than twice as
// fast.
#undef UNROLLED
#define UNROLLED _Pragma("GCC unroll 9")

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;
using D = Real::D;
static_assert(kFitsAtOnce == kRealLanes);
constexpr int kLinear = 3;     // x, y, z
constexpr int kQuadratic = 6;  // xx, yy, zz, xy, yz, xz
constexpr int kUnknowns = kLinear + kQuadratic;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A quadratic monomial as the product of two coordinates.
struct Pair
{
  int a, b;
};
constexpr std::array<Pair, kQuadratic> kPairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// Place among the moments of the product of up to four coordinates; -1: none.
constexpr int productIndex(int a, int b = -1, int c = -1, int d = -1)
{
  int powers[3] = {};
  for (const int axis : {a, b, c, d}) {
    if (axis >= 0) {
      ++powers[axis];
    }
  }
  return momentIndex(powers[0], powers[1], powers[2]);
}

template <int Rows, int Columns>
using Matrix = std::array<std::array<Real, Columns>, Rows>;
template <int Size>
using Vector = std::array<Real, Size>;

/// What the eigenproblem (M - lambda N) c = 0 is made of, after elimination of the constant. In the basis of x, y, z
/// and of the quadratic monomials less their mean gradient N falls apart into the identity and `gradients`.
struct Scatter
{
  Matrix<kLinear, kLinear> covariance;
  Matrix<kQuadratic, kLinear> mixed;         // lower left of M
  Matrix<kQuadratic, kQuadratic> quadratic;  // lower right of M, on and below the diagonal
  Matrix<kQuadratic, kQuadratic> gradients;  // lower right of N, likewise
};

HWY_ATTR HWY_INLINE void scatterOf(const std::array<Real, kMomentCount>& mean, Scatter& scatter)
{
  const auto E = [&](int a) HWY_ATTR { return mean[productIndex(a)]; };
  auto& V = scatter.covariance;
  UNROLLED
  for (int a = 0; a < kLinear; ++a) {
    UNROLLED
    for (int b = 0; b < kLinear; ++b) {
      V[a][b] = mean[productIndex(a, b)] - E(a) * E(b);
    }
  }
  Matrix<kQuadratic, kLinear> raw;  // before the mean gradient is taken off
  UNROLLED
  for (int p = 0; p < kQuadratic; ++p) {
    const auto [a, b] = kPairs[p];
    UNROLLED
    for (int c = 0; c < kLinear; ++c) {
      raw[p][c] = mean[productIndex(a, b, c)] - mean[productIndex(a, b)] * E(c);
      scatter.mixed[p][c] = raw[p][c] - (E(b) * V[a][c] + E(a) * V[b][c]);
    }
  }
  UNROLLED
  for (int p = 0; p < kQuadratic; ++p) {
    const auto [a, b] = kPairs[p];
    UNROLLED
    for (int q = 0; q <= p; ++q) {
      const auto [c, d] = kPairs[q];
      const Real both = mean[productIndex(a, b, c, d)] - mean[productIndex(a, b)] * mean[productIndex(c, d)];
      scatter.quadratic[p][q] =
          both - (raw[p][c] * E(d) + raw[p][d] * E(c)) - (E(b) * scatter.mixed[q][a] + E(a) * scatter.mixed[q][b]);
      Real gradients(0.0);
      gradients += a == c ? V[b][d] : Real();
      gradients += a == d ? V[b][c] : Real();
      gradients += b == c ? V[a][d] : Real();
      gradients += b == d ? V[a][c] : Real();
      scatter.gradients[p][q] = gradients;
    }
  }
}

// The smallest pivot is the square of twice the RMS thickness of the points, relative to the radius.
constexpr double kSmallestPivot = 1e-10;

/// Cholesky factor of a symmetric matrix.
struct Cholesky
{
  Matrix<kQuadratic, kQuadratic> L;  // below the diagonal
  Vector<kQuadratic> inverse_diagonal;
  Condition regular;  // all pivots are large enough

  HWY_ATTR HWY_INLINE explicit Cholesky(const Matrix<kQuadratic, kQuadratic>& symmetric)
      : regular(Real(0.0) < Real(1.0))
  {
    UNROLLED
    for (int j = 0; j < kQuadratic; ++j) {
      UNROLLED
      for (int i = j; i < kQuadratic; ++i) {
        Real sum = symmetric[i][j];
        UNROLLED
        for (int k = 0; k < j; ++k) {
          sum -= L[i][k] * L[j][k];
        }
        if (i == j) {
          regular = hn::And(regular, Real(kSmallestPivot) < sum);  // false for NaN
          inverse_diagonal[j] = Real(1.0) / squareRoot(sum);
        } else {
          L[i][j] = sum * inverse_diagonal[j];
        }
      }
    }
  }

  /// x := L^-1 x
  HWY_ATTR HWY_INLINE void solveForward(Vector<kQuadratic>& x) const
  {
    UNROLLED
    for (int i = 0; i < kQuadratic; ++i) {
      UNROLLED
      for (int k = 0; k < i; ++k) {
        x[i] -= L[i][k] * x[k];
      }
      x[i] = x[i] * inverse_diagonal[i];
    }
  }

  /// x := L'^-1 x
  HWY_ATTR HWY_INLINE void solveBackward(Vector<kQuadratic>& x) const
  {
    UNROLLED
    for (int i = kQuadratic - 1; i >= 0; --i) {
      UNROLLED
      for (int k = i + 1; k < kQuadratic; ++k) {
        x[i] -= L[k][i] * x[k];
      }
      x[i] = x[i] * inverse_diagonal[i];
    }
  }
};

/// The ordinary symmetric eigenproblem that remains when N is divided out of M by its Cholesky factor.
HWY_ATTR HWY_INLINE Matrix<kUnknowns, kUnknowns> reduced(const Scatter& scatter, const Cholesky& cholesky)
{
  Matrix<kUnknowns, kUnknowns> K;
  UNROLLED
  for (int i = 0; i < kLinear; ++i) {
    UNROLLED
    for (int j = 0; j <= i; ++j) {
      K[i][j] = scatter.covariance[i][j];
    }
    Vector<kQuadratic> column;
    UNROLLED
    for (int p = 0; p < kQuadratic; ++p) {
      column[p] = scatter.mixed[p][i];
    }
    cholesky.solveForward(column);
    UNROLLED
    for (int p = 0; p < kQuadratic; ++p) {
      K[kLinear + p][i] = column[p];
    }
  }
  Matrix<kQuadratic, kQuadratic> half;  // row q: column q of L^-1 R
  UNROLLED
  for (int q = 0; q < kQuadratic; ++q) {
    UNROLLED
    for (int p = 0; p < kQuadratic; ++p) {
      half[q][p] = p >= q ? scatter.quadratic[p][q] : scatter.quadratic[q][p];
    }
    cholesky.solveForward(half[q]);
  }
  UNROLLED
  for (int p = 0; p < kQuadratic; ++p) {
    Vector<kQuadratic> row;
    UNROLLED
    for (int q = 0; q < kQuadratic; ++q) {
      row[q] = half[q][p];
    }
    cholesky.solveForward(row);
    UNROLLED
    for (int q = 0; q <= p; ++q) {
      K[kLinear + p][kLinear + q] = row[q];
    }
  }
  return K;
}

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
  /// Reflects what is below the diagonal of column k onto its first entry.
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

/// Laguerre's iteration for the smallest eigenvalue, from below: it never passes that, and triples the number of digits
/// with each step (J. H. Wilkinson, "The Algebraic Eigenvalue Problem", 1965, chapter 7). Left of all eigenvalues all
/// pivots are positive.
struct SmallestEigenvalue
{
  Real value;
  Condition converged;

  HWY_ATTR HWY_INLINE SmallestEigenvalue(const Tridiagonal& T, Real rounding) : converged(rounding < rounding)
  {
    constexpr int kMostSteps = 24;
    const Real degree = static_cast<double>(kUnknowns);
    value = Real(0.0) - Real(8.0) * rounding;
    for (int step = 0; step < kMostSteps && !hn::AllTrue(D(), converged); ++step) {
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
      // Where a pivot is not positive the last step has reached the eigenvalue to rounding.
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

HWY_ATTR void fitLanes(QuadricFits& fits, std::size_t begin)
{
  const D d;
  std::array<Real, kMomentCount> mean;
  const Real inverse_count = Real(1.0) / Real(hn::Load(d, &fits.moments[0][begin]));
  UNROLLED
  for (int m = 0; m < kMomentCount; ++m) {
    mean[m] = Real(hn::Load(d, &fits.moments[m][begin])) * inverse_count;
  }
  Scatter scatter;
  scatterOf(mean, scatter);
  const Cholesky cholesky(scatter.gradients);
  Matrix<kUnknowns, kUnknowns> K = reduced(scatter, cholesky);
  const Tridiagonal T(K);

  const Real rounding = Real(4.0 * kEpsilon) * T.trace;
  const SmallestEigenvalue smallest(T, rounding);
  Vector<kUnknowns> y = eigenvector(T, smallest.value);
  T.transformBack(y);

  constexpr double kSeparation = 1e-14;
  const Real below = eigenvaluesBelow(T, smallest.value + Real(kSeparation) * T.trace);
  const Condition twin = Real(1.5) < below;
  const Condition found = hn::And(smallest.converged, Real(0.5) < below);

  Vector<kQuadratic> c;
  UNROLLED
  for (int p = 0; p < kQuadratic; ++p) {
    c[p] = y[kLinear + p];
  }
  cholesky.solveBackward(c);
  Real constant(0.0);
  UNROLLED
  for (int p = 0; p < kQuadratic; ++p) {
    const auto [a, b] = kPairs[p];
    y[a] -= c[p] * mean[productIndex(b)];
    y[b] -= c[p] * mean[productIndex(a)];
    constant -= c[p] * mean[productIndex(a, b)];
    hn::Store(c[p].lanes, d, &fits.coefficients[p][begin]);
  }
  UNROLLED
  for (int a = 0; a < kLinear; ++a) {
    constant -= y[a] * mean[productIndex(a)];
    hn::Store(y[a].lanes, d, &fits.coefficients[kQuadratic + a][begin]);
  }
  hn::Store(constant.lanes, d, &fits.coefficients[kUnknowns][begin]);
  hn::Store(smallest.value.lanes, d, &fits.eigenvalue[begin]);

  alignas(64) PerFit status;
  const Real settled = choose(found, choose(twin, Real(1.0), Real(0.0)), Real(2.0));
  hn::Store(choose(cholesky.regular, settled, Real(1.0)).lanes, d, status.data());
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    fits.status[begin + lane] = static_cast<FitStatus>(static_cast<int>(status[lane]));
  }
}

HWY_ATTR void fitQuadrics(QuadricFits& fits, std::size_t count)
{
  for (std::size_t begin = 0; begin < count; begin += hn::Lanes(D())) {
    fitLanes(fits, begin);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(fitQuadrics);

void fitQuadrics(QuadricFits& fits, std::size_t count)
{
  HWY_DYNAMIC_DISPATCH(fitQuadrics)(fits, count);
}

}  // namespace grasp_affordances
#endif
