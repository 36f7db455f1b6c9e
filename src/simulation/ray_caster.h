#pragma once

#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace grasp_affordances
{

/// The first surface on a ray.
struct Hit
{
  double t;  ///< in units of the ray's direction
  const Part* part;
};

/// Casts rays from one point into a scene, which must outlive it. Safe to use from several threads.
class RayCaster
{
public:
  /// The rays start at the camera's origin.
  RayCaster(const Scene& scene, const Eigen::Isometry3d& T_scene_camera);

  /// @param direction in the camera's frame, of any length but zero. If its z is 1, Hit::t is the depth.
  std::optional<Hit> cast(const Eigen::Vector3d& direction) const;

private:
  struct Target
  {
    const Part* part;
    Eigen::Vector3d centre_camera;  ///< of the bounding sphere
    double bounding_radius;
    Eigen::Matrix3d R_shape_camera;
    Eigen::Vector3d camera_shape;  ///< the camera's origin in the shape's frame
  };

  std::vector<Target> targets_;
};

}  // namespace grasp_affordances
