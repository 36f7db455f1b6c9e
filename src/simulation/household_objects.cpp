#include "simulation/household_objects.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cmath>

namespace grasp_affordances
{

Scene randomLamp(CounterRandom& random)
{
  const double base = random.uniform(0.06, 0.075);
  const double post_top = random.uniform(0.24, 0.29);
  constexpr double shade_height = 0.11;
  Scene scene;
  scene.beginObject("lamp");
  scene.add(Revolution{{{0.0, base}, {0.012, base}, {0.022, 0.025}}}, Eigen::Isometry3d::Identity());
  addBar(scene, {0.0, 0.0, 0.02}, {0.0, 0.0, post_top}, random.uniform(0.009, 0.012));
  scene.add(Frustum{random.uniform(0.085, 0.1), 0.06, shade_height, 0.003}, at(0.0, 0.0, post_top + 0.02));
  return scene;
}

Scene randomHairBrush(CounterRandom& random)
{
  const double bristles = random.uniform(0.02, 0.025);
  Scene scene;
  scene.beginObject("hair brush");
  scene.add(Box{{0.075, 0.042, bristles}}, at(0.0, 0.0, 0.5 * bristles), Surface::dark);
  scene.add(Ellipsoid{{0.055, 0.033, 0.012}}, at(0.0, 0.0, bristles + 0.006));
  const Eigen::Vector3d root(0.05, 0.0, bristles + 0.008);
  const double end_radius = random.uniform(0.011, 0.0125);
  const double root_radius = random.uniform(0.0085, 0.0095);
  const double length = random.uniform(0.11, 0.13);
  addTaper(scene, root, root + Eigen::Vector3d(length, 0.0, 0.006), root_radius, end_radius);
  return scene;
}

Scene randomHammer(CounterRandom& random)
{
  const double head = random.uniform(0.0145, 0.017);
  const double length = random.uniform(0.2, 0.25);
  Scene scene;
  scene.beginObject("hammer");
  addBar(scene, {-0.055, 0.0, head}, {0.055, 0.0, head}, head, Surface::dark);
  const double end_radius = random.uniform(0.014, 0.0165);
  const double root_radius = random.uniform(0.011, 0.0125);
  addTaper(scene, {0.0, 0.0, head}, {0.0, 0.0, head + length}, root_radius, end_radius);
  return scene;
}

Scene randomPhone(CounterRandom& random)
{
  constexpr double base = 0.035;
  const double length = random.uniform(0.15, 0.17);
  const double lean = kDegree * random.uniform(6.0, 14.0);
  Scene scene;
  scene.beginObject("cordless phone");
  scene.add(Box{{0.095, 0.085, base}}, at(0.0, 0.0, 0.5 * base), Surface::dark);
  scene.add(EllipticCylinder{random.uniform(0.0175, 0.018), random.uniform(0.0195, 0.0205), length},
            at(0.0, 0.0, base - 0.01) * turned(-lean, Eigen::Vector3d::UnitY()) * at(0.0, 0.0, 0.5 * length));
  return scene;
}

Scene randomFlashlight(CounterRandom& random)
{
  const double head = random.uniform(0.0285, 0.032);
  const double barrel = random.uniform(0.0145, 0.0175);
  const double length = random.uniform(0.1, 0.13);
  Scene scene;
  scene.beginObject("flashlight");
  scene.add(
      Revolution{
          {{0.0, head}, {0.035, head}, {0.06, barrel}, {0.06 + length, barrel}, {0.065 + length, barrel - 0.003}}},
      Eigen::Isometry3d::Identity());
  return scene;
}

Scene randomTape(CounterRandom& random)
{
  const double height = random.uniform(0.022, 0.05);
  const double radius = random.uniform(0.045, 0.055);
  Scene scene;
  scene.beginObject("tape");
  scene.add(Cylinder{radius, height, random.uniform(0.008, 0.016)}, at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomBook(CounterRandom& random)
{
  const double thickness = random.uniform(0.02, 0.045);
  Scene scene;
  scene.beginObject("book");
  scene.add(Box{{random.uniform(0.13, 0.17), random.uniform(0.19, 0.23), thickness}}, at(0.0, 0.0, 0.5 * thickness));
  return scene;
}

Scene randomCarton(CounterRandom& random)
{
  const double height = random.uniform(0.07, 0.16);
  Scene scene;
  scene.beginObject("box");
  scene.add(Box{{random.uniform(0.065, 0.09), random.uniform(0.11, 0.18), height}}, at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomOpenCarton(CounterRandom& random)
{
  const double height = random.uniform(0.1, 0.14);
  const double width = random.uniform(0.2, 0.28);
  const double depth = random.uniform(0.16, 0.22);
  constexpr double wall = 0.004;
  Scene scene;
  scene.beginObject("open box");
  scene.add(Box{{depth, width, wall}}, at(0.0, 0.0, 0.5 * wall));
  for (const double side : {-0.5, 0.5}) {
    scene.add(Box{{wall, width, height}}, at(side * (depth - wall), 0.0, 0.5 * height));
    scene.add(Box{{depth, wall, height}}, at(0.0, side * (width - wall), 0.5 * height));
  }
  return scene;
}

Scene randomLotionBottle(CounterRandom& random)
{
  const double height = random.uniform(0.15, 0.18);
  Scene scene;
  scene.beginObject("lotion bottle");
  scene.add(EllipticCylinder{random.uniform(0.029, 0.031), random.uniform(0.04, 0.045), height},
            at(0.0, 0.0, 0.5 * height));
  scene.add(Cylinder{random.uniform(0.014, 0.018), 0.02}, at(0.0, 0.0, height + 0.01));
  return scene;
}

Scene apple(double radius)
{
  constexpr int bands = 12;
  Revolution flesh;
  for (int band = 0; band <= bands; ++band) {
    // The profile ends before the poles: blossom and stalk leave flat ends.
    const double latitude = 80.0 * kDegree * (2.0 * band / bands - 1.0);
    flesh.profile.push_back({radius * std::sin(latitude), radius * std::cos(latitude)});
  }
  Scene scene;
  scene.beginObject("apple");
  scene.add(flesh, at(0.0, 0.0, -flesh.profile.front().z));
  return scene;
}

Scene randomApple(CounterRandom& random)
{
  return apple(random.uniform(0.034, 0.04));
}

Scene randomBananaOnBlock(CounterRandom& random)
{
  const double block_height = random.uniform(0.035, 0.05);
  const double tube = random.uniform(0.016, 0.018);
  const double bend = random.uniform(0.1, 0.12);
  constexpr double half_angle = 0.55;
  Scene scene;
  scene.beginObject("block");
  scene.add(Box{{0.1, 0.12, block_height}}, at(0.0, 0.0, 0.5 * block_height));

  // Near its middle it lies on the block's edge at y = 0.06.
  scene.beginObject("banana");
  const Eigen::Isometry3d T = at(-bend, 0.05, block_height + tube);
  const auto addEnd = [&](double side, double length) {
    const Eigen::Vector3d direction(-std::sin(half_angle), side * std::cos(half_angle), 0.0);
    const Eigen::Vector3d start(bend * std::cos(half_angle), side * bend * std::sin(half_angle), 0.0);
    return addTaper(scene, T * start, T * (start + length * direction), tube, 0.007);
  };
  const std::size_t lying = addEnd(-1.0, 0.025);
  const std::size_t middle = scene.add(TorusArc{bend, tube, half_angle}, T);
  const std::size_t free = addEnd(1.0, 0.035);
  scene.join({lying, middle, free});
  return scene;
}

Scene randomSuitcase(CounterRandom& random)
{
  const double height = random.uniform(0.24, 0.28);
  const double width = random.uniform(0.34, 0.4);
  const double depth = random.uniform(0.12, 0.15);
  const double half_grip = 0.5 * random.uniform(0.11, 0.14);
  Scene scene;
  scene.beginObject("suitcase");
  scene.add(Box{{depth, width, height}}, at(0.0, 0.0, 0.5 * height), Surface::dark);
  const HandleFeet feet{{0.0, -half_grip, height - 0.002}, {0.0, half_grip, height - 0.002}, Eigen::Vector3d::UnitZ()};
  const double tube_radius = random.uniform(0.01, 0.0125);
  const double rise = random.uniform(0.042, 0.05);
  addStaple(scene, feet, rise, 0.018, tube_radius, Surface::dark);
  return scene;
}

Scene randomLyingSuitcase(CounterRandom& random)
{
  const double height = random.uniform(0.13, 0.16);
  const double width = random.uniform(0.36, 0.42);
  const double depth = random.uniform(0.25, 0.29);
  const double half_grip = 0.5 * random.uniform(0.11, 0.14);
  const double x = 0.5 * depth - 0.002;
  Scene scene;
  scene.beginObject("lying suitcase");
  scene.add(Box{{depth, width, height}}, at(0.0, 0.0, 0.5 * height), Surface::dark);
  const HandleFeet feet{{x, -half_grip, 0.5 * height}, {x, half_grip, 0.5 * height}, Eigen::Vector3d::UnitX()};
  const double tube_radius = random.uniform(0.01, 0.0125);
  const double rise = random.uniform(0.042, 0.05);
  addStaple(scene, feet, rise, 0.018, tube_radius);
  return scene;
}

Scene randomBackpack(CounterRandom& random)
{
  const double height = random.uniform(0.27, 0.32);
  const double width = random.uniform(0.22, 0.26);
  const double depth = random.uniform(0.12, 0.14);
  Scene scene;
  scene.beginObject("backpack");
  scene.add(Box{{depth, width, height}}, at(0.0, 0.0, 0.5 * height));
  const double pocket = 0.4 * height;
  scene.add(Box{{0.04, 0.75 * width, pocket}}, at(0.5 * depth + 0.02, 0.0, 0.5 * pocket + 0.02));
  const HandleFeet feet{{0.0, -0.045, height - 0.003}, {0.0, 0.045, height - 0.003}, Eigen::Vector3d::UnitZ()};
  const double tube_radius = random.uniform(0.007, 0.009);
  const double rise = random.uniform(0.043, 0.05);
  addBow(scene, feet, rise, tube_radius);
  return scene;
}

Scene randomLongBox(CounterRandom& random)
{
  const double height = random.uniform(0.06, 0.07);
  Scene scene;
  scene.beginObject("long box");
  scene.add(Box{{random.uniform(0.062, 0.075), random.uniform(0.17, 0.22), height}}, at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomShelf(CounterRandom& random)
{
  const double height = random.uniform(0.14, 0.18);
  const double width = random.uniform(0.28, 0.34);
  const double depth = random.uniform(0.13, 0.16);
  constexpr double board = 0.018;
  Scene scene;
  scene.beginObject("shelf");
  for (const double side : {-0.5, 0.5}) {
    scene.add(Box{{depth, board, height}}, at(0.0, side * (width - board), 0.5 * height));
  }
  scene.add(Box{{depth + 0.02, width + 0.02, board}}, at(0.0, 0.0, height + 0.5 * board));
  return scene;
}

namespace
{

/// A bar and its mounts, on a wall at x.
void addCloseBar(Scene& scene, double x, double z, double half_length, double clearance)
{
  constexpr double radius = 0.01;
  const double axis = x + clearance + radius;
  addBar(scene, {axis, -half_length, z}, {axis, half_length, z}, radius);
  for (const double side : {-1.0, 1.0})
    scene.add(Box{{0.028, 0.02, 0.024}}, at(x + 0.014, side * half_length, z));
}

}  // namespace

Scene randomCloseBar(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("close bar");
  const double clearance = random.uniform(0.003, 0.0045);
  const double half_length = random.uniform(0.06, 0.09);
  addCloseBar(scene, 0.0, 0.0, half_length, clearance);
  return scene;
}

Scene randomBlockWithCloseBar(CounterRandom& random)
{
  const double half_length = random.uniform(0.06, 0.09);
  const Eigen::Vector3d block(0.08, 2.0 * half_length + 0.06, random.uniform(0.12, 0.16));
  Scene scene;
  scene.beginObject("block with close bar");
  scene.add(Box{block}, at(0.0, 0.0, 0.5 * block.z()));
  addCloseBar(scene, 0.5 * block.x(), 0.65 * block.z(), half_length, random.uniform(0.003, 0.0045));
  return scene;
}

}  // namespace grasp_affordances
