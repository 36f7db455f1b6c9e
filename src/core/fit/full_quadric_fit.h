#pragma once

#include "core/kernels/quadric_fits.h"

#include <cstddef>

namespace grasp_affordances
{

/// Taubin's fit (paper, section III-A) to the neighborhood of one lane, as fitQuadrics but by Eigen's full solver for
/// symmetric generalized eigenproblems. The lane is settled afterwards: never not_converged.
void fitQuadricFully(QuadricFits& fits, std::size_t lane);

}  // namespace grasp_affordances
