#pragma once

#include "simulation/scene.h"
#include "simulation/sensor_model.h"
#include "simulation/sensor_noise.h"

#include <Eigen/Core>

#include <cstdint>

namespace grasp_affordances
{

/// Decides where enough of the projector's light returns to be matched, and not too much of it.
class InfraredReturn
{
public:
  InfraredReturn(const SensorModel& model, std::uint64_t seed);

  /// @param point of the surface, in the optical frame; m
  /// @param normal of the surface, in either direction, of any length but zero
  /// @param column,row of the pixel that sees the point; the results of neighbouring pixels are correlated
  bool suffices(Surface surface, const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::uint32_t column,
                std::uint32_t row) const;

private:
  double breakdown_;   ///< cosine of the angle of incidence at which the matching fails
  double dark_reach_;  ///< m, depth at which a dark surface, seen at right angles, returns just enough light
  double too_dull_;    ///< above, a patch of a shiny surface reflects too much light elsewhere
  Eigen::Vector3d projector_;
  PatchNoise patches_;
};

}  // namespace grasp_affordances
