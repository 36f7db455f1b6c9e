#pragma once

#include "simulation/scene.h"
#include "simulation/sensor_noise.h"

#include <Eigen/Core>

#include <cstdint>

namespace grasp_affordances
{

/// Decides where enough of the projector's light returns to be matched, and not too much of it.
class InfraredReturn
{
public:
  /// @param baseline m, from the camera to the projector on +x
  InfraredReturn(std::uint64_t seed, double baseline);

  /// @param point of the surface, in the optical frame; m
  /// @param normal of the surface, in either direction, of any length but zero
  /// @param column,row of the pixel that sees the point; the results of neighbouring pixels are correlated
  bool suffices(Surface surface, const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::uint32_t column,
                std::uint32_t row) const;

private:
  Eigen::Vector3d projector_;
  PatchNoise patches_;
};

}  // namespace grasp_affordances
