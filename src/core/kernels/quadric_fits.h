#pragma once

#include "core/kernels/moment_sums.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

constexpr std::size_t kFitsAtOnce = 8;

/// One number per neighborhood.
using PerFit = std::array<double, kFitsAtOnce>;

enum class FitStatus : std::uint8_t
{
  unique,
  not_unique,    ///< the points determine no unique quadric
  not_converged  ///< the iteration for the smallest eigenvalue did not converge: the full solver has to decide
};

/// Several neighborhoods, to which quadrics are fitted at once.
struct QuadricFits
{
  alignas(64) std::array<PerFit, kMomentCount> moments;  ///< in: by momentIndex, in coordinates scaled by the radius

  /// Out: coefficients of xx, yy, zz, xy, yz, xz, x, y, z and 1, in the same coordinates. Valid where unique.
  alignas(64) std::array<PerFit, 10> coefficients;
  alignas(64) PerFit eigenvalue;              ///< out: the smallest one; valid where unique
  std::array<FitStatus, kFitsAtOnce> status;  ///< out
};

/// Taubin's fit (paper, section III-A) to the first `count` neighborhoods, each in a lane of its own: the result does
/// not depend on what is in the others.
void fitQuadrics(QuadricFits& fits, std::size_t count);

}  // namespace grasp_affordances
