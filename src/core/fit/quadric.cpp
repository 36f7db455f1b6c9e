#include "core/fit/quadric.h"

#include "core/fit/full_quadric_fit.h"
#include "core/kernels/moment_sums.h"
#include "core/kernels/quadric_fits.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

constexpr int kGradientUnknowns = 9;  // all but the constant
static_assert(Moments::kCount == kMomentCount && TaubinFitter::kCapacity == kFitsAtOnce, "as in the kernels");

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
    if (lanes.status[i] == FitStatus::not_converged) {
      ++implementation_->solved_fully;
      fitQuadricFully(lanes, i);
    }
    auto& result = implementation_->results[i];
    result.reset();
    if (lanes.status[i] == FitStatus::unique) {
      result = implementation_->fitOf(i);
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
  const auto c = [this, i](int a) { return lanes.coefficients[a][i]; };
  TaubinFit fit;
  fit.residual = std::max(0.0, lanes.eigenvalue[i]);
  Quadric& quadric = fit.quadric;
  quadric.origin = origins[i];
  quadric.scale = scales[i];
  quadric.A << c(0), c(3) / 2, c(5) / 2,  //
      c(3) / 2, c(1), c(4) / 2,           //
      c(5) / 2, c(4) / 2, c(2);
  quadric.b << c(6), c(7), c(8);
  quadric.c = c(9);
  return fit;
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
