#pragma once

#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace grasp_affordances
{

// Things to put on a table, made of primitives. The frame of each has its origin on the table below its middle, z up.
// Metres. The part that a hand can close around gets the given label, everything else 0.

/// An open mug with a handle towards +x.
struct Mug
{
  double radius = 0.04;
  double height = 0.115;
  double wall = 0.005;
  double floor = 0.008;
  double handle_radius = 0.0425;  ///< of the circle that the handle's tube follows
  double handle_tube_radius = 0.0079;
  double handle_clearance = 0.0315;  ///< between the mug and the inside of its handle, at the widest place
};
void add(Scene& scene, const Eigen::Isometry3d& T_scene_mug, const Mug& mug, std::uint32_t handle_label);

/// A bottle with a slim neck.
struct Bottle
{
  double radius = 0.0355;
  double body_height = 0.12;
  double shoulder_height = 0.025;
  double neck_radius = 0.015;
  double neck_length = 0.06;
};
void add(Scene& scene, const Eigen::Isometry3d& T_scene_bottle, const Bottle& bottle, std::uint32_t neck_label);

/// A round bar along x between two posts.
struct MountedBar
{
  double radius = 0.0115;
  double length = 0.15;       ///< between the posts
  double axis_height = 0.07;  ///< above the table
  double post_width = 0.056;
  double post_height = 0.095;
};
void add(Scene& scene, const Eigen::Isometry3d& T_scene_bar, const MountedBar& bar, std::uint32_t bar_label);

}  // namespace grasp_affordances
