#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <optional>

namespace grasp_affordances
{

template <int N>
struct Eigenpair
{
  double value;
  Eigen::Matrix<double, N, 1> vector;  // unit
};

/// Number of eigenvalues of a symmetric matrix below `shift`: negative pivots of its LDL' factorization (Sylvester's
/// law of inertia).
template <int N>
int eigenvaluesBelow(Eigen::Matrix<double, N, N> symmetric, double shift)
{
  symmetric.diagonal().array() -= shift;
  int negative = 0;
  for (int k = 0; k < N; ++k) {
    const double pivot = symmetric(k, k);
    negative += pivot < 0.0 ? 1 : 0;
    for (int j = k + 1; j < N; ++j) {
      symmetric.col(j).tail(N - j) -= symmetric(j, k) / pivot * symmetric.col(k).tail(N - j);
    }
  }
  return negative;
}

/// Smallest eigenvalue of a symmetric positive semidefinite matrix with its vector, by inverse and then Rayleigh
/// quotient iteration; a third of the cost of the full decomposition. Empty where the iteration settles elsewhere or
/// not at all, or where the second eigenvalue lies within `separation` or rounding of the first.
template <int N>
std::optional<Eigenpair<N>> iterateToSmallest(const Eigen::Matrix<double, N, N>& matrix, double separation)
{
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double trace = matrix.trace();

  Matrix shifted = matrix;
  shifted.diagonal().array() += 1e3 * kEpsilon * trace;
  const Eigen::LLT<Matrix> inverse(shifted);
  if (inverse.info() != Eigen::Success) {
    return std::nullopt;
  }
  Vector x = inverse.solve(Vector::Ones()).normalized();
  constexpr int kInverseSteps = 4, kRayleighSteps = 6;
  for (int i = 1; i < kInverseSteps; ++i) {
    x = inverse.solve(x).normalized();
  }

  for (int i = 0; i < kRayleighSteps; ++i) {
    const Vector product = matrix * x;
    const double quotient = x.dot(product);
    if ((product - quotient * x).norm() <= 8 * kEpsilon * trace) {
      const double rounding = 32 * kEpsilon * trace;
      const bool alone = eigenvaluesBelow(matrix, quotient - rounding) == 0 &&
                         eigenvaluesBelow(matrix, quotient + std::max(separation, rounding)) == 1;
      return alone ? std::optional<Eigenpair<N>>({quotient, x}) : std::nullopt;
    }
    shifted = matrix;
    shifted.diagonal().array() -= quotient;
    x = shifted.partialPivLu().solve(x).normalized();
  }
  return std::nullopt;
}

/// As iterateToSmallest, but by full decomposition where that gives up; empty only where the two smallest eigenvalues
/// lie within `separation` or the matrix is not finite.
template <int N>
std::optional<Eigenpair<N>> smallestEigenpair(const Eigen::Matrix<double, N, N>& matrix, double separation)
{
  if (const auto iterated = iterateToSmallest(matrix, separation)) {
    return iterated;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(matrix);
  if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()[1] - eigen.eigenvalues()[0] > separation)) {
    return std::nullopt;
  }
  return Eigenpair<N>{eigen.eigenvalues()[0], eigen.eigenvectors().col(0)};
}

}  // namespace grasp_affordances
