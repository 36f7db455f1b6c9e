#include "core/kernels/quadric_fits.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/quadric_fits.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_real.h"
#include "core/kernels/simd_symmetric_eigen.h"

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
static_assert(kUnknowns == kLinear + kQuadratic);

/// A quadratic monomial as the product of two coordinates.
struct Pair
{
  int a, b;
};
constexpr std::array<Pair, kQuadratic> kPairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// The place among the moments of a product of up to four coordinates; -1 stands for no coordinate.
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

/// The matrices of the eigenproblem (M - lambda N) c = 0, without the constant term. The basis is x, y, z and the
/// quadratic monomials less their mean gradient: in it N consists of two blocks, the identity and `gradients`.
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

// Where the points are thin along a coordinate, the smallest pivot is the square of twice their RMS thickness, relative
// to the radius; where they are thin in another direction it is less.
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

/// The ordinary symmetric eigenproblem that is left when M is divided by the Cholesky factor of N.
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
