#pragma once

#include "simulation/scene.h"

#include <Eigen/Core>

#include <cstddef>

namespace grasp_affordances
{

// Building blocks of objects. Each function adds parts to the scene's last object. All lengths are in metres.

/// An open vessel whose floor, as thick as its wall, stands on z = 0 of its frame.
void addVessel(Scene& scene, const Eigen::Isometry3d& T_scene_vessel, const Frustum& wall,
               Surface surface = Surface::diffuse);

/// A round bar between two points. @return the part's index.
std::size_t addBar(Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                   Surface surface = Surface::diffuse);

/// A bar whose radius changes from one end to the other. @return the part's index.
std::size_t addTaper(Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double from_radius,
                     double to_radius, Surface surface = Surface::diffuse);

/// Where a handle is attached, and the direction in which it stands out.
struct HandleFeet
{
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  Eigen::Vector3d outwards;  ///< unit, at right angles to the line between the feet
};

/// A handle that is one arc. @param rise of its axis above the feet. @return the part's index.
std::size_t addBow(Scene& scene, const HandleFeet& feet, double rise, double tube_radius,
                   Surface surface = Surface::diffuse);

/// A straight grip on two legs with rounded corners, joined to one chain.
/// @param rise of its axis above the feet; more than the corners' radius.
void addStaple(Scene& scene, const HandleFeet& feet, double rise, double corner_radius, double tube_radius,
               Surface surface = Surface::diffuse);

}  // namespace grasp_affordances
