#include "core/fit/full_quadric_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <array>

namespace grasp_affordances
{
namespace
{

struct Monomial
{
  int i, j, k;  // x^i y^j z^k
};

// l(x) in the order of the paper's f (equation 1), not of its l.
constexpr int kUnknowns = 10;
constexpr int kGradientUnknowns = 9;  // all but the constant
constexpr std::array<Monomial, kUnknowns> kQuadricMonomials{
    {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

using Matrix9 = Eigen::Matrix<double, kGradientUnknowns, kGradientUnknowns>;

// The moments that make up an entry of M and N. An entry of M needs the product of two monomials, one of N up to three
// products of their derivatives.
struct Entry
{
  int row, column;
  int product;
  int row_monomial, column_monomial;
  std::array<int, 3> derivative_product;
  std::array<double, 3> derivative_factor;
};
constexpr int kEntries = kGradientUnknowns * (kGradientUnknowns + 1) / 2;  // on and below the diagonal
constexpr std::array<Entry, kEntries> makeEntries()
{
  std::array<Entry, kEntries> entries{};
  int e = 0;
  for (int a = 0; a < kGradientUnknowns; ++a) {
    for (int b = 0; b <= a; ++b, ++e) {
      const Monomial p = kQuadricMonomials[a], q = kQuadricMonomials[b];
      const int i = p.i + q.i, j = p.j + q.j, k = p.k + q.k;
      Entry& entry = entries[e];
      entry.row = a;
      entry.column = b;
      entry.product = momentIndex(i, j, k);
      entry.row_monomial = momentIndex(p.i, p.j, p.k);
      entry.column_monomial = momentIndex(q.i, q.j, q.k);
      const int factors[3] = {p.i * q.i, p.j * q.j, p.k * q.k};
      for (int d = 0; d < 3; ++d) {
        entry.derivative_factor[d] = factors[d];
        if (factors[d] > 0) {
          entry.derivative_product[d] = momentIndex(i - (d == 0 ? 2 : 0), j - (d == 1 ? 2 : 0), k - (d == 2 ? 2 : 0));
        }
      }
    }
  }
  return entries;
}
constexpr std::array<Entry, kEntries> kMatrixEntries = makeEntries();

struct Scatter
{
  Matrix9 M;  // equation 2, without the constant term, whose best value is minus the mean of the other terms
  Matrix9 N;  // the sum of l_x l_x' + l_y l_y' + l_z l_z'
};

using Means = std::array<double, kMomentCount>;

Scatter scatterOf(const Means& means)
{
  Scatter scatter;
  for (const Entry& e : kMatrixEntries) {
    const double m = means[e.product] - means[e.row_monomial] * means[e.column_monomial];
    double n = 0.0;
    for (int d = 0; d < 3; ++d) {
      n += e.derivative_factor[d] * means[e.derivative_product[d]];
    }
    scatter.M(e.row, e.column) = scatter.M(e.column, e.row) = m;
    scatter.N(e.row, e.column) = scatter.N(e.column, e.row) = n;
  }
  return scatter;
}

}  // namespace

void fitQuadricFully(QuadricFits& fits, std::size_t lane)
{
  Means means;
  for (int m = 0; m < kMomentCount; ++m) {
    means[m] = fits.moments[m][lane] / fits.moments[0][lane];
  }
  const auto [M, N] = scatterOf(means);
  fits.status[lane] = FitStatus::not_unique;
  if (Eigen::LLT<Matrix9>(N).info() != Eigen::Success) {  // the solver below needs a positive definite N
    return;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix9> eigen(M, N);
  constexpr double kSeparation = 1e-14;
  const auto& eigenvalues = eigen.eigenvalues();
  if (eigen.info() != Eigen::Success || !(eigenvalues[1] - eigenvalues[0] > kSeparation * eigenvalues.sum())) {
    return;
  }
  fits.status[lane] = FitStatus::unique;
  fits.eigenvalue[lane] = eigenvalues[0];
  double constant = 0.0;
  for (int a = 0; a < kGradientUnknowns; ++a) {
    const double c = eigen.eigenvectors()(a, 0);
    const Monomial p = kQuadricMonomials[a];
    constant -= c * means[momentIndex(p.i, p.j, p.k)];
    fits.coefficients[a][lane] = c;
  }
  fits.coefficients[kGradientUnknowns][lane] = constant;
}

}  // namespace grasp_affordances
