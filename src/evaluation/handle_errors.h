#pragma once

#include "grasp_affordances/handle.h"
#include "simulation/ground_truth.h"

#include <limits>

namespace grasp_affordances
{

/// How far a handle is from the affordance that it finds. NaN where that is not known.
struct HandleErrors
{
  double center = std::numeric_limits<double>::quiet_NaN();  ///< m, of the centroid, at right angles to the axis
  double axis = std::numeric_limits<double>::quiet_NaN();    ///< rad, between the axes, in [0, pi/2]
  double radius = std::numeric_limits<double>::quiet_NaN();  ///< m, by which it is taken to be thicker than it is
};

/// Compares a handle with the affordance's axis and radius where that axis is nearest to the handle's centroid. A ball
/// has no direction: its centre is compared with the handle's axis, and its largest radius with the handle's.
///
/// @param affordance  in the handle's frame; without an axis nothing is known
HandleErrors handleErrors(const GraspHandle& handle, const Affordance& affordance);

}  // namespace grasp_affordances
