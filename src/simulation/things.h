#pragma once

#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstddef>

namespace grasp_affordances
{

/// Whether an object stays as it is, whatever the background.
bool isThing(Role role);

/// Bounding box, in a frame, of the pointsInside() of an object.
Eigen::AlignedBox3d boundsOf(const Scene& scene, std::size_t object, const Eigen::Isometry3d& T_frame_scene);

/// The same of all things and fronts; empty if there are none.
Eigen::AlignedBox3d boundsOfThings(const Scene& scene, const Eigen::Isometry3d& T_frame_scene);

/// Middle of the bounding box of the things and fronts; the origin if there are none.
Eigen::Vector3d middleOfThings(const Scene& scene);

}  // namespace grasp_affordances
