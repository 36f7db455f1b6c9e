#pragma once

#include "simulation/grip_labels.h"
#include "simulation/placement.h"

#include <Eigen/Geometry>

#include <vector>

namespace grasp_affordances::test
{

const GraspDefinition kDefinition;  // capture radius 2.6 cm, clearance 0.8 cm, length 3 cm

/// Turned so that its z axis points along the scene's x axis.
inline Eigen::Isometry3d lying(double x, double y, double z)
{
  return at(x, y, z) * Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitY());
}

inline GripLabels label(const Scene& scene, double margin = 0.0)
{
  return GripLabels(scene, kDefinition, [margin](const Eigen::Vector3d&) { return margin; });
}

inline std::vector<Grip> gripsOfSolid(const Primitive& solid, const Eigen::Isometry3d& T_scene_shape)
{
  Scene scene;
  scene.add(solid, T_scene_shape);
  return label(scene).grips();
}

}  // namespace grasp_affordances::test
