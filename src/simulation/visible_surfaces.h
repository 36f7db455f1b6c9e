#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// The nearest surface in each pixel, row-major.
struct SurfaceImage
{
  std::vector<float> depth;        ///< m, along the optical axis; infinite where there is none
  std::vector<std::int32_t> part;  ///< index into Scene::parts(); -1 where there is none
};

/// The surfaces of a scene that a camera sees.
struct VisibleSurfaces
{
  SurfaceImage opaque;
  SurfaceImage transparent;  ///< the nearest transparent surfaces, also those behind opaque ones
};

/// Casts a ray through the centre of every pixel of a pinhole camera. A part is tested only in the pixels to which its
/// bounding box projects. Rows are processed in parallel; the result does not depend on the number of threads.
VisibleSurfaces findVisibleSurfaces(const Scene& scene, const Eigen::Isometry3d& T_scene_camera,
                                    const PinholeIntrinsics& camera, std::uint32_t width, std::uint32_t height);

}  // namespace grasp_affordances
