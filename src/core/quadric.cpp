#include "grasp_affordances/quadric.h"

#include "core/moment_sums.h"
#include "core/quadric_fits.h"
#include "core/smallest_eigenvector.h"

#include <Eigen/Cholesky>

#include <algorithm>

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
static_assert(Moments::kCount == kMomentCount && TaubinFitter::kCapacity == kFitsAtOnce, "as in the kernels");
constexpr int kGradientUnknowns = 9;  // all but the constant
constexpr std::array<Monomial, kUnknowns> kQuadricMonomials{
    {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

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

using Means = std::array<double, Moments::kCount>;

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

using Vector10 = Eigen::Matrix<double, kUnknowns, 1>;

TaubinFit makeFit(const Vector10& c, double eigenvalue, const Eigen::Vector3d& origin, double scale)
{
  TaubinFit fit;
  fit.residual = std::max(0.0, eigenvalue);
  Quadric& quadric = fit.quadric;
  quadric.origin = origin;
  quadric.scale = scale;
  quadric.A << c[0], c[3] / 2, c[5] / 2,  //
      c[3] / 2, c[1], c[4] / 2,           //
      c[5] / 2, c[4] / 2, c[2];
  quadric.b = c.segment<3>(6);
  quadric.c = c[9];
  return fit;
}

/// One of the fits by Eigen's full decomposition.
std::optional<TaubinFit> solveFully(const QuadricFits& fits, std::size_t i, const Eigen::Vector3d& origin, double scale)
{
  Means means;
  for (int m = 0; m < Moments::kCount; ++m) {
    means[m] = fits.moments[m][i] / fits.moments[0][i];
  }
  const auto [M, N] = scatterOf(means);
  const Eigen::LLT<Matrix9> cholesky(N);
  if (cholesky.info() != Eigen::Success) {
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
  Vector10 c;
  c << cholesky.matrixU().solve(smallest->vector), 0.0;
  for (int a = 0; a < kGradientUnknowns; ++a) {
    const Monomial p = kQuadricMonomials[a];
    c[9] -= c[a] * means[momentIndex(p.i, p.j, p.k)];
  }
  return makeFit(c, smallest->value, origin, scale);
}

}  // namespace

Moments::Moments(const Neighborhood& neighborhood, int degree)
{
  const float* const coordinates[3] = {neighborhood.x(), neighborhood.y(), neighborhood.z()};
  const double center[3] = {neighborhood.center.x(), neighborhood.center.y(), neighborhood.center.z()};
  sumMoments(coordinates, neighborhood.size(), center, sums_.data(), degree);
  const double scale = 1.0 / neighborhood.radius;
  double factor = 1.0;
  for (int d = 1, m = 1; d <= degree; ++d) {
    factor *= scale;
    for (; m < momentCount(d); ++m) {
      sums_[m] *= factor;
    }
  }
}

double Moments::sum(int i, int j, int k) const
{
  return sums_[momentIndex(i, j, k)];
}

struct TaubinFitter::Implementation
{
  TaubinFit fitOf(std::size_t i) const;

  QuadricFits lanes;
  std::array<Eigen::Vector3d, kCapacity> origins;
  std::array<double, kCapacity> scales;
  std::array<std::optional<TaubinFit>, kCapacity> results;
  std::size_t size = 0;
  std::size_t solved_fully = 0;
};

TaubinFitter::TaubinFitter() : implementation_(std::make_unique<Implementation>()) {}
TaubinFitter::~TaubinFitter() = default;
TaubinFitter::TaubinFitter(TaubinFitter&&) noexcept = default;
TaubinFitter& TaubinFitter::operator=(TaubinFitter&&) noexcept = default;

std::size_t TaubinFitter::size() const
{
  return implementation_->size;
}

void TaubinFitter::clear()
{
  implementation_->size = 0;
}

void TaubinFitter::add(const Moments& moments, const Eigen::Vector3d& origin, double scale)
{
  const std::size_t lane = implementation_->size++;
  for (int m = 0; m < Moments::kCount; ++m) {
    implementation_->lanes.moments[m][lane] = moments.sums()[m];
  }
  implementation_->origins[lane] = origin;
  implementation_->scales[lane] = scale;
}

void TaubinFitter::fit()
{
  QuadricFits& lanes = implementation_->lanes;
  fitQuadrics(lanes, implementation_->size);
  for (std::size_t i = 0; i < implementation_->size; ++i) {
    auto& result = implementation_->results[i];
    result.reset();
    if (lanes.status[i] == FitStatus::unique) {
      result = implementation_->fitOf(i);
    } else if (lanes.status[i] == FitStatus::not_converged) {
      ++implementation_->solved_fully;
      result = solveFully(lanes, i, implementation_->origins[i], implementation_->scales[i]);
    }
  }
}

std::optional<TaubinFit> TaubinFitter::operator[](std::size_t i) const
{
  return implementation_->results[i];
}

std::size_t TaubinFitter::solvedFully() const
{
  return implementation_->solved_fully;
}

TaubinFit TaubinFitter::Implementation::fitOf(std::size_t i) const
{
  Vector10 c;
  for (int a = 0; a < kUnknowns; ++a) {
    c[a] = lanes.coefficients[a][i];
  }
  return makeFit(c, lanes.eigenvalue[i], origins[i], scales[i]);
}

std::optional<TaubinFit> fitTaubin(const Moments& moments, const Eigen::Vector3d& origin, double scale)
{
  TaubinFitter fitter;
  fitter.add(moments, origin, scale);
  fitter.fit();
  return fitter[0];
}

std::optional<TaubinFit> fitTaubin(const Neighborhood& neighborhood)
{
  if (neighborhood.size() < kGradientUnknowns || !(neighborhood.radius > 0.0F)) {
    return std::nullopt;
  }
  return fitTaubin(Moments(neighborhood), neighborhood.center.cast<double>(), neighborhood.radius);
}

}  // namespace grasp_affordances
