#pragma once

#include "core/kernels/quadric_fits.h"

#include <cstddef>

namespace grasp_affordances
{

/// Taubin's fit (paper, section III-A) to the neighborhood of one lane, as fitQuadrics() does it, but by Eigen's full
/// solver for symmetric generalized eigenproblems. The lane's status is never not_converged afterwards.
void fitQuadricFully(QuadricFits& fits, std::size_t lane);

}  // namespace grasp_affordances
