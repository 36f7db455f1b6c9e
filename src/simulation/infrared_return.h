#pragma once

#include "simulation/scene.h"
#include "simulation/sensor_noise.h"

#include <Eigen/Core>

#include <cstdint>

namespace grasp_affordances
{

/// Decides where the projector's light comes back strongly enough, and not too strongly, to be matched.
class InfraredReturn
{
public:
  /// @param baseline m, from the camera to the projector on +x
  InfraredReturn(std::uint64_t seed, double baseline);

  /// @param point of the surface, in the optical frame; m
  /// @param normal of the surface, either way and of any length but zero
  /// @param column,row of the pixel that sees it: neighbours share their fate
  bool suffices(Surface surface, const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::uint32_t column,
                std::uint32_t row) const;

private:
  Eigen::Vector3d projector_;
  PatchNoise patches_;
};

}  // namespace grasp_affordances
