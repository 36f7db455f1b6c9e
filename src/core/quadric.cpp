#include "grasp_affordances/quadric.h"

#include "core/smallest_eigenvector.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <utility>

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

// Place of x^i y^j z^k among the moments: graded by degree, then by k, then by j.
constexpr int momentIndex(int i, int j, int k)
{
  const int degree = i + j + k;
  const int before = degree * (degree + 1) * (degree + 2) / 6;
  return before + k * (2 * degree + 3 - k) / 2 + j;
}
static_assert(momentIndex(0, 0, 4) == Moments::kCount - 1, "moments are numbered without gaps");

// Each moment of degree 2 or more is the sum of products of two terms of at most degree 2: the table tells which.
constexpr int kTerms = 10;  // moments of degree at most 2
struct Factors
{
  int first, second;
};
constexpr std::array<Factors, Moments::kCount> makeFactors()
{
  std::array<Factors, Moments::kCount> factors{};
  for (int degree = 2; degree <= 4; ++degree) {
    for (int k = 0; k <= degree; ++k) {
      for (int j = 0; j + k <= degree; ++j) {
        // Of a degree above 2 the first factor takes two units, of degree 2 one.
        const int units = degree > 2 ? 2 : 1;
        const int i = degree - j - k;
        const int di = i < units ? i : units;
        const int dj = j < units - di ? j : units - di;
        const int dk = units - di - dj;
        factors[momentIndex(i, j, k)] = {momentIndex(di, dj, dk), momentIndex(i - di, j - dj, k - dk)};
      }
    }
  }
  return factors;
}
constexpr std::array<Factors, Moments::kCount> kFactors = makeFactors();

// Points are summed a tile at a time, which stays in the processor's nearest memory while each moment runs over it.
constexpr Eigen::Index kTile = 32;
using Tile = Eigen::Array<double, kTile, 1>;

/// Adds the sums over a tile of the moments First + I, a few at a time, so that their sums stay in registers.
template <std::size_t First, std::size_t... I>
inline void addProducts(const std::array<Tile, kTerms>& terms, std::array<double, Moments::kCount>& sums,
                        std::index_sequence<I...>)
{
  std::array<Eigen::Array2d, sizeof...(I)> partial;
  partial.fill(Eigen::Array2d::Zero());
  for (Eigen::Index i = 0; i < kTile; i += 2) {
    ((partial[I] += terms[kFactors[First + I].first].template segment<2>(i) *
                    terms[kFactors[First + I].second].template segment<2>(i)),
     ...);
  }
  ((sums[First + I] += partial[I].sum()), ...);
}

/// (coordinate - middle) * scale of `count` points; zero, which adds nothing, beyond them.
inline Tile localCoordinates(const float* coordinate, Eigen::Index count, double middle, double scale)
{
  if (count == kTile) {
    return (Eigen::Map<const Eigen::Array<float, kTile, 1>>(coordinate).cast<double>() - middle) * scale;
  }
  Tile tile = Tile::Zero();
  tile.head(count) = (Eigen::Map<const Eigen::ArrayXf>(coordinate, count).cast<double>() - middle) * scale;
  return tile;
}

using Matrix9 = Eigen::Matrix<double, kGradientUnknowns, kGradientUnknowns>;
using Vector9 = Eigen::Matrix<double, kGradientUnknowns, 1>;

// Which moments make up an entry of M and N: of M the product of two monomials, of N up to three products of their
// derivatives.
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
  Matrix9 M;  // equation 2, after elimination of the constant, whose optimum is minus the mean of the other terms
  Matrix9 N;  // the sum of l_x l_x' + l_y l_y' + l_z l_z'
};

Scatter scatterOf(const Moments& moments)
{
  std::array<double, Moments::kCount> means;
  for (int m = 0; m < Moments::kCount; ++m) {
    means[m] = moments[m] / moments[0];
  }
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

Moments::Moments(const Neighborhood& neighborhood)
{
  const double scale = 1.0 / neighborhood.radius;
  const Eigen::Vector3d center = neighborhood.center.cast<double>();
  const auto n = static_cast<Eigen::Index>(neighborhood.size());
  sums_[0] = static_cast<double>(n);
  std::array<Tile, kTerms> terms;  // [0], the constant, is not used
  for (Eigen::Index begin = 0; begin < n; begin += kTile) {
    const Eigen::Index count = std::min(kTile, n - begin);
    terms[1] = localCoordinates(neighborhood.x() + begin, count, center.x(), scale);
    terms[2] = localCoordinates(neighborhood.y() + begin, count, center.y(), scale);
    terms[3] = localCoordinates(neighborhood.z() + begin, count, center.z(), scale);
    for (int m = 4; m < kTerms; ++m) {
      terms[m] = terms[kFactors[m].first] * terms[kFactors[m].second];
    }
    for (int m = 1; m < kTerms; ++m) {
      sums_[m] += terms[m].sum();
    }
    addProducts<10>(terms, sums_, std::make_index_sequence<5>());
    addProducts<15>(terms, sums_, std::make_index_sequence<5>());
    addProducts<20>(terms, sums_, std::make_index_sequence<8>());
    addProducts<28>(terms, sums_, std::make_index_sequence<7>());
  }
}

double Moments::sum(int i, int j, int k) const
{
  return sums_[momentIndex(i, j, k)];
}

std::optional<TaubinFit> fitTaubin(const Moments& moments, const Eigen::Vector3d& origin, double scale)
{
  const auto [M, N] = scatterOf(moments);

  // The smallest pivot is the square of twice the RMS thickness, relative to the radius.
  constexpr double kSmallestPivot = 1e-10;
  const Eigen::LLT<Matrix9> cholesky(N);
  const Vector9 pivots = cholesky.matrixLLT().diagonal();
  if (cholesky.info() != Eigen::Success || !(pivots.minCoeff() * pivots.minCoeff() > kSmallestPivot)) {
    return std::nullopt;
  }

  // With N = LL' and c = L^-T y the problem is the ordinary symmetric one of L^-1 M L^-T.
  Matrix9 reduced = cholesky.matrixL().solve(M);
  reduced = cholesky.matrixL().solve(reduced.transpose()).eval();
  constexpr double kRounding = 1e-14;
  const auto smallest = smallestEigenpair(reduced, kRounding * reduced.trace());
  if (!smallest) {
    return std::nullopt;
  }
  const Vector9 c = cholesky.matrixU().solve(smallest->vector);

  TaubinFit fit;
  fit.residual = std::max(0.0, smallest->value);
  Quadric& quadric = fit.quadric;
  quadric.origin = origin;
  quadric.scale = scale;
  quadric.A << c[0], c[3] / 2, c[5] / 2,  //
      c[3] / 2, c[1], c[4] / 2,           //
      c[5] / 2, c[4] / 2, c[2];
  quadric.b = c.tail<3>();
  for (int a = 0; a < kGradientUnknowns; ++a) {
    const Monomial p = kQuadricMonomials[a];
    quadric.c -= c[a] * moments.sum(p.i, p.j, p.k) / moments.sum(0, 0, 0);
  }
  return fit;
}

std::optional<TaubinFit> fitTaubin(const Neighborhood& neighborhood)
{
  if (neighborhood.size() < kGradientUnknowns || !(neighborhood.radius > 0.0F)) {
    return std::nullopt;
  }
  return fitTaubin(Moments(neighborhood), neighborhood.center.cast<double>(), neighborhood.radius);
}

}  // namespace grasp_affordances
