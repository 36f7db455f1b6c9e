#pragma once

#include "simulation/grip_axis.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// What stands around the parts of a scene, which must outlive it.
class Surroundings
{
public:
  explicit Surroundings(const Scene& scene);

  /// Least distance, up to `limit`, from a part's surface to another solid, radially outwards from an axis of the part
  /// and between two places on it; 0 where that surface is inside another solid. The geometry is exact, every 3 degrees
  /// in three sections. The far side of a ring counts as another solid.
  /// @param chain parts that do not count, the part itself among them
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
