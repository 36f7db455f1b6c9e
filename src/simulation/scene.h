#pragma once

#include "simulation/primitive.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What a surface does with the sensor's infrared light.
enum class Surface
{
  diffuse,   ///< is measured
  absorbing  ///< hides what lies behind it and is not measured itself
};

/// A solid in its place.
struct Part
{
  Primitive shape;
  Eigen::Isometry3d T_scene_shape;
  std::uint32_t label;  ///< 0: not graspable; 1..: the affordance that it belongs to
  Surface surface;
};

/// Solids that may overlap; what the sensor sees is their union. Things made of several solids are several parts.
class Scene
{
public:
  /// @throw std::invalid_argument for a shape whose dimensions describe no solid.
  void add(const Primitive& shape, const Eigen::Isometry3d& T_scene_shape, std::uint32_t label = 0,
           Surface surface = Surface::diffuse);

  const std::vector<Part>& parts() const { return parts_; }

private:
  std::vector<Part> parts_;
};

}  // namespace grasp_affordances
