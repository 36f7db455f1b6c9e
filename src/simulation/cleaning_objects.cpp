#include "simulation/cleaning_objects.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cmath>

namespace grasp_affordances
{

Scene randomDustPan(CounterRandom& random)
{
  const double width = random.uniform(0.19, 0.23);
  const double depth = random.uniform(0.17, 0.2);
  const double side_height = random.uniform(0.032, 0.04);
  const double back_height = random.uniform(0.045, 0.05);
  constexpr double wall = 0.004;
  Scene scene;
  scene.beginObject("dust pan");
  scene.add(Box{{depth, width, wall}}, at(0.0, 0.0, 0.5 * wall));
  for (const double side : {-0.5, 0.5})
    scene.add(Box{{depth, wall, side_height}}, at(0.0, side * width, 0.5 * side_height));
  scene.add(Box{{wall, width, back_height}}, at(0.5 * depth, 0.0, 0.5 * back_height));

  const double pitch = kDegree * random.uniform(8.0, 16.0);
  const Eigen::Vector3d root(0.5 * depth, 0.0, 0.033);
  const double end_radius = random.uniform(0.013, 0.015);
  const double root_radius = random.uniform(0.011, 0.0125);
  const double length = random.uniform(0.11, 0.13);
  addTaper(scene, root, root + length * Eigen::Vector3d(std::cos(pitch), 0.0, std::sin(pitch)), root_radius,
           end_radius);
  return scene;
}

Scene randomBrush(CounterRandom& random)
{
  const double bristles = random.uniform(0.03, 0.04);
  constexpr double block = 0.022;
  const double half_length = 0.5 * random.uniform(0.13, 0.16);
  const double width = random.uniform(0.055, 0.065);
  Scene scene;
  scene.beginObject("brush");
  scene.add(Box{{2.0 * half_length - 0.01, width - 0.008, bristles}}, at(0.0, 0.0, 0.5 * bristles), Surface::dark);
  scene.add(Box{{2.0 * half_length, width, block}}, at(0.0, 0.0, bristles + 0.5 * block));
  const Eigen::Vector3d root(half_length - 0.005, 0.0, bristles + 0.5 * block);
  const double end_radius = random.uniform(0.012, 0.0145);
  const double root_radius = random.uniform(0.0095, 0.0105);
  const double length = random.uniform(0.12, 0.14);
  addTaper(scene, root, root + Eigen::Vector3d(length, 0.0, 0.012), root_radius, end_radius);
  return scene;
}

Scene randomSprayBottle(CounterRandom& random)
{
  const double body = random.uniform(0.034, 0.04);
  const double neck = random.uniform(0.0135, 0.016);
  const double shoulder_z = random.uniform(0.12, 0.14);
  const double neck_z = shoulder_z + random.uniform(0.03, 0.04);
  const double head_z = neck_z + random.uniform(0.04, 0.048);
  constexpr double head_height = 0.034;
  Scene scene;
  scene.beginObject("spray bottle");
  scene.add(Revolution{{{0.0, body}, {shoulder_z, body}, {neck_z, neck}, {head_z, neck}}},
            Eigen::Isometry3d::Identity());
  scene.add(Box{{0.085, 0.046, head_height}}, at(0.012, 0.0, head_z + 0.5 * head_height));
  scene.add(Box{{0.008, 0.014, 0.03}}, at(0.047, 0.0, head_z - 0.014), Surface::dark);
  return scene;
}

Scene randomJug(CounterRandom& random)
{
  const double radius = random.uniform(0.062, 0.072);
  const double shoulder_z = random.uniform(0.15, 0.17);
  const double neck_z = shoulder_z + random.uniform(0.03, 0.04);
  const double cap_z = neck_z + random.uniform(0.014, 0.018);
  const double cap = random.uniform(0.0205, 0.0225);
  Scene scene;
  scene.beginObject("jug");
  scene.add(Revolution{{{0.0, radius},
                        {shoulder_z, radius},
                        {neck_z, cap - 0.003},
                        {cap_z, cap - 0.003},
                        {cap_z + 0.001, cap},
                        {cap_z + 0.026, cap}}},
            Eigen::Isometry3d::Identity());
  const HandleFeet feet{
      {radius - 0.003, 0.0, 0.035}, {radius - 0.003, 0.0, shoulder_z - 0.01}, Eigen::Vector3d::UnitX()};
  const double tube_radius = random.uniform(0.009, 0.0115);
  const double rise = random.uniform(0.045, 0.05);
  addBow(scene, feet, rise, tube_radius);
  return scene;
}

Scene randomBucket(CounterRandom& random)
{
  const double top = random.uniform(0.095, 0.11);
  const double height = random.uniform(0.14, 0.17);
  const double bail = top + 0.006;
  constexpr double wire = 0.0035;
  constexpr double half_grip = 0.4;
  const double half_side = 0.5 * (0.5 * kPi - half_grip);
  // Rotation of the bail about the y axis through its hinges; 0 is upright.
  const double tilt = kDegree * random.uniform(-30.0, 30.0);
  Scene scene;
  scene.beginObject("bucket");
  addVessel(scene, Eigen::Isometry3d::Identity(), {0.78 * top, top, height, 0.003});
  const Eigen::Isometry3d hinge = at(0.0, 0.0, height - 0.01) * turned(tilt, Eigen::Vector3d::UnitY()) *
                                  turned(-0.5 * kPi, Eigen::Vector3d::UnitY());
  const auto turn = [&](double angle) { return hinge * turned(angle, Eigen::Vector3d::UnitZ()); };
  const std::size_t left = scene.add(TorusArc{bail, wire, half_side}, turn(-half_grip - half_side), Surface::shiny);
  const std::size_t grip = scene.add(TorusArc{bail, random.uniform(0.011, 0.013), half_grip}, turn(0.0));
  const std::size_t right = scene.add(TorusArc{bail, wire, half_side}, turn(half_grip + half_side), Surface::shiny);
  scene.join({left, grip, right});
  return scene;
}

Scene randomSponge(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("sponge");
  const double height = random.uniform(0.035, 0.045);
  scene.add(Box{{random.uniform(0.11, 0.13), random.uniform(0.075, 0.09), height}}, at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomBroom(CounterRandom& random, double reach)
{
  const double head_height = random.uniform(0.08, 0.1);
  const double top = random.uniform(0.36, 0.42);
  Scene scene;
  scene.beginObject("broom");
  scene.add(Box{{0.055, random.uniform(0.2, 0.24), head_height}}, at(0.0, 0.0, 0.5 * head_height));
  addBar(scene, {0.0, 0.0, head_height - 0.01}, {reach, 0.0, top}, random.uniform(0.0115, 0.0135));
  return scene;
}

}  // namespace grasp_affordances
