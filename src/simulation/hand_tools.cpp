#include "simulation/hand_tools.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

constexpr double kAcross = 90.0 * kDegree;

/// Frame in the middle of a straight part whose z axis is tilted from the vertical towards +x.
Eigen::Isometry3d leaning(const Eigen::Vector3d& foot, double lean, double length)
{
  return Eigen::Translation3d(foot) * turned(lean, Eigen::Vector3d::UnitY()) * at(0.0, 0.0, 0.5 * length);
}

/// Frame whose z axis is the x axis of the scene.
Eigen::Isometry3d alongX(double x, double y, double z)
{
  return at(x, y, z) * turned(kAcross, Eigen::Vector3d::UnitY());
}

}  // namespace

Scene randomDrill(CounterRandom& random)
{
  constexpr double battery = 0.05;
  const double length = random.uniform(0.105, 0.125);
  const double lean = kDegree * random.uniform(4.0, 12.0);
  const double axis = battery + length * std::cos(lean) + 0.018;
  const double body = random.uniform(0.029, 0.033);
  const double chuck = random.uniform(0.019, 0.021);
  Scene scene;
  scene.beginObject("drill");
  scene.add(RoundedBox{{0.115, 0.075, battery}, 0.012}, at(0.015, 0.0, 0.5 * battery));
  scene.add(RoundedBox{{random.uniform(0.036, 0.042), random.uniform(0.029, 0.033), length}, 0.011},
            leaning({0.01, 0.0, battery - 0.004}, -lean, length));
  scene.add(Revolution{{{-0.075, 0.8 * body},
                        {-0.06, body},
                        {0.06, body},
                        {0.075, chuck + 0.002},
                        {0.077, chuck},
                        {0.115, chuck},
                        {0.128, 0.01}}},
            alongX(0.0, 0.0, axis));
  addBar(scene, {0.12, 0.0, axis}, {0.128 + random.uniform(0.01, 0.024), 0.0, axis}, 0.003);
  return scene;
}

Scene randomPliersOnBlock(CounterRandom& random)
{
  const double height = random.uniform(0.045, 0.07);
  const double length = random.uniform(0.12, 0.14);
  const double spread = kDegree * random.uniform(9.0, 13.0);
  const double thick = random.uniform(0.0065, 0.0085);
  Scene scene;
  scene.beginObject("block");
  scene.add(Box{{0.1, 0.12, height}}, at(-0.05, 0.0, 0.5 * height));

  scene.beginObject("pliers");
  const double z = height + thick;
  scene.add(Ellipsoid{{0.045, 0.021, thick}}, at(-0.03, 0.0, z), Surface::dark);
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Isometry3d T_handle =
        at(-0.02, 0.0, z) * turned(side * spread, Eigen::Vector3d::UnitZ()) * alongX(0.5 * length, 0.0, 0.0);
    scene.add(Oval{thick, 1.3 * thick, length, random.uniform(1.0, 1.25)}, T_handle);
  }
  return scene;
}

Scene randomClawHammer(CounterRandom& random)
{
  const double head = random.uniform(0.026, 0.032);
  const double length = random.uniform(0.22, 0.27);
  Scene scene;
  scene.beginObject("claw hammer");
  scene.add(RoundedBox{{0.03, head, 0.11}, 0.008}, alongX(0.0, 0.0, 0.015), Surface::dark);
  const double wide = random.uniform(0.0125, 0.014);
  scene.add(Oval{wide, 0.75 * wide, length, random.uniform(1.2, 1.4)}, at(0.0, 0.0, 0.02 + 0.5 * length));
  return scene;
}

Scene randomScrewdriverRack(CounterRandom& random)
{
  constexpr double height = 0.06, distance = 0.065;
  const int count = random.coin() ? 3 : 2;
  Scene scene;
  scene.beginObject("rack");
  scene.add(Box{{0.07, count * distance, height}}, at(0.0, 0.0, 0.5 * height));
  for (int i = 0; i < count; ++i) {
    const double y = (i - 0.5 * (count - 1)) * distance;
    const double shaft_top = height + random.uniform(0.012, 0.022);
    const double length = random.uniform(0.085, 0.105);
    const double radius = random.uniform(0.0125, 0.0165);
    scene.beginObject("screwdriver");
    addBar(scene, {0.0, y, height + 0.002}, {0.0, y, shaft_top}, 0.003);
    if (random.coin()) {
      scene.add(RoundedBox{{2.0 * radius, 2.0 * radius, length}, 0.5 * radius}, at(0.0, y, shaft_top + 0.5 * length));
    } else {
      scene.add(Revolution{{{0.0, 0.7 * radius}, {0.02, radius}, {length - 0.015, radius}, {length, 0.7 * radius}}},
                at(0.0, y, shaft_top));
    }
  }
  return scene;
}

Scene randomIron(CounterRandom& random)
{
  constexpr double body_top = 0.075;
  const double room = random.uniform(0.022, 0.027);
  const double length = random.uniform(0.13, 0.15);
  const double high = random.uniform(0.026, 0.031);
  const double z = body_top + room + 0.5 * high;
  Scene scene;
  scene.beginObject("iron");
  scene.add(RoundedBox{{0.24, 0.11, 0.025}, 0.054}, at(0.0, 0.0, 0.0125), Surface::shiny);
  scene.add(RoundedBox{{0.2, 0.085, body_top - 0.025}, 0.042}, at(-0.01, 0.0, 0.5 * (body_top + 0.025)));
  for (const double x : {-0.5 * length, 0.5 * length})
    addBar(scene, {x - 0.01, 0.0, body_top - 0.01}, {x - 0.01, 0.0, z}, 0.012);
  scene.add(RoundedBox{{high, random.uniform(0.032, 0.037), length + 0.03}, 0.011}, alongX(-0.01, 0.0, z));
  return scene;
}

Scene randomHairDryer(CounterRandom& random)
{
  const double back = random.uniform(0.038, 0.043);
  const double front = random.uniform(0.026, 0.031);
  const double length = random.uniform(0.18, 0.21);
  const double handle = random.uniform(0.11, 0.13);
  const double pitch = std::atan2(back - front, length);  // both ends touch the table
  Scene scene;
  scene.beginObject("hair dryer");
  scene.add(Frustum{back, front, length},
            at(-0.02, 0.0, 0.5 * (back + front)) * turned(pitch, Eigen::Vector3d::UnitY()) * alongX(0.0, 0.0, 0.0));
  scene.add(Oval{random.uniform(0.019, 0.022), random.uniform(0.015, 0.0175), handle, 0.9},
            leaning({-0.05, 0.0, back + 0.8 * back}, -kDegree * random.uniform(5.0, 20.0), handle));
  return scene;
}

Scene randomWateringCan(CounterRandom& random)
{
  const double bottom = random.uniform(0.065, 0.075), top = random.uniform(0.05, 0.058);
  const double height = random.uniform(0.13, 0.16);
  const double spout = random.uniform(0.011, 0.014);
  const double tube = random.uniform(0.008, 0.011);
  Scene scene;
  scene.beginObject("watering can");
  addVessel(scene, Eigen::Isometry3d::Identity(), {bottom, top, height, 0.003});
  addTaper(scene, {0.9 * bottom, 0.0, 0.03}, {bottom + random.uniform(0.1, 0.13), 0.0, height + 0.03}, spout,
           0.8 * spout);
  const Eigen::Vector3d low(-0.93 * bottom, 0.0, 0.3 * height), high(-0.97 * top, 0.0, 0.96 * height);
  const Eigen::Vector3d along = (high - low).normalized();
  addBow(scene, {low, high, Eigen::Vector3d(-along.z(), 0.0, along.x())}, random.uniform(0.042, 0.052), tube);
  return scene;
}

}  // namespace grasp_affordances
