#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

namespace grasp_affordances
{

// Tableware, made of primitives. Each function adds a new object to the scene. The object's frame has the origin on the
// table below its middle, and z up; a front or handle points towards +x. All lengths are in metres.

/// An open mug with a handle towards +x.
struct Mug
{
  double radius = 0.04;
  double height = 0.115;
  double wall = 0.005;
  double floor = 0.008;
  double handle_radius = 0.0425;  ///< radius of the centre line of the handle's tube
  double handle_tube_radius = 0.0079;
  double handle_clearance = 0.0315;  ///< largest distance between the mug and the inside of its handle
};
void add(Scene& scene, const Eigen::Isometry3d& T_scene_mug, const Mug& mug);

/// A bottle with a slim neck.
struct Bottle
{
  double radius = 0.0355;
  double body_height = 0.12;
  double shoulder_height = 0.025;
  double neck_radius = 0.015;
  double neck_length = 0.06;
};
void add(Scene& scene, const Eigen::Isometry3d& T_scene_bottle, const Bottle& bottle);

/// A round bar along x between two posts.
struct MountedBar
{
  double radius = 0.0115;
  double length = 0.15;       ///< between the posts
  double axis_height = 0.07;  ///< above the table
  double post_width = 0.056;
  double post_height = 0.095;
};
void add(Scene& scene, const Eigen::Isometry3d& T_scene_bar, const MountedBar& bar);

// Each of these functions returns a scene with one object of random size.

Scene randomMug(CounterRandom& random);
/// Its neck and cap can be grasped.
Scene randomDressingBottle(CounterRandom& random);
/// A glass in a metal frame, with a handle; the plunger is pressed down.
Scene randomFrenchPress(CounterRandom& random);
/// Its handle is an arc over the lid.
Scene randomKettle(CounterRandom& random);
Scene randomPot(CounterRandom& random);
Scene randomPan(CounterRandom& random);
/// Lies along x, with a handle at each end.
Scene randomRollingPin(CounterRandom& random);
/// Two objects: a bowl and a ladle that leans on its rim.
Scene randomBowlWithLadle(CounterRandom& random);
Scene randomBowl(CounterRandom& random);
Scene randomPlate(CounterRandom& random);
/// A cup without handle, too wide to be grasped.
Scene randomCup(CounterRandom& random);
/// Too wide to be grasped.
Scene randomCan(CounterRandom& random);
/// A can on its side, along y.
Scene randomLyingCan(CounterRandom& random);

}  // namespace grasp_affordances
