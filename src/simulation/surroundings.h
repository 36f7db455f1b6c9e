#pragma once

#include "simulation/grip_axis.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Measures the free space around the parts of a scene. The scene must outlive it.
class Surroundings
{
public:
  explicit Surroundings(const Scene& scene);

  /// Least distance, up to `limit`, from a part's surface to another solid, between two places on an axis of the part.
  /// It is measured radially, away from the axis; it is 0 if the surface is inside another solid. The geometry is
  /// exact; the distance is sampled every 3 degrees in three sections. The far side of a ring counts as another solid.
  /// @param chain parts to ignore, including the part itself
  double clearance(std::size_t part, const GripAxis& axis, double from, double to,
                   const std::vector<std::size_t>& chain, double limit) const;

private:
  struct Solid
  {
    const Primitive* shape;
    Eigen::Isometry3d T_shape_scene;
    Eigen::AlignedBox3d bounds;  ///< in the shape's frame
  };

  std::vector<Solid> solids_;
};

}  // namespace grasp_affordances
