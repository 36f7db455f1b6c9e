#include "simulation/desk_objects.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cmath>

namespace grasp_affordances
{

Scene randomPenCup(CounterRandom& random)
{
  const double radius = random.uniform(0.036, 0.042);
  const double height = random.uniform(0.104, 0.118);
  constexpr double wall = 0.003;
  const int count = 4 + static_cast<int>(random.uniform(0.0, 3.0));
  Scene scene;
  scene.beginObject("cup");
  addVessel(scene, Eigen::Isometry3d::Identity(), {radius, radius, height, wall});
  const double first = random.uniform(0.0, 2.0 * kPi);
  for (int i = 0; i < count; ++i) {
    const bool marker = random.uniform() < 0.4;
    const double pen = marker ? random.uniform(0.0075, 0.009) : random.uniform(0.0038, 0.005);
    const double length = random.uniform(0.116, 0.138);
    const double azimuth = first + 2.0 * kPi * (i + random.uniform(-0.1, 0.1)) / count;
    const Eigen::Vector3d outwards(std::cos(azimuth), std::sin(azimuth), 0.0);
    // It leans on the inside of the rim.
    const double at_rim = radius - wall - pen - 0.002;
    const double at_floor = random.uniform(0.8, 0.95) * at_rim;
    const Eigen::Vector3d foot = at_floor * outwards + Eigen::Vector3d(0.0, 0.0, wall + 0.004);
    const Eigen::Vector3d rim = at_rim * outwards + Eigen::Vector3d(0.0, 0.0, height);
    scene.beginObject(marker ? "marker" : "pen");
    addBar(scene, foot, foot + length * (rim - foot).normalized(), pen);
  }
  return scene;
}

Scene randomMonitor(CounterRandom& random)
{
  const double width = random.uniform(0.34, 0.4), height = random.uniform(0.2, 0.23);
  const double bottom = random.uniform(0.05, 0.08);
  const double z = bottom + 0.5 * height;
  constexpr double frame = 0.012;
  Scene scene;
  scene.beginObject("monitor");
  scene.add(Box{{0.15, 0.2, 0.01}}, at(-0.02, 0.0, 0.005));
  addBar(scene, {-0.05, 0.0, 0.0}, {-0.05, 0.0, z}, random.uniform(0.014, 0.02));
  scene.add(Box{{0.03, width, height}}, at(-0.015, 0.0, z));
  scene.add(Box{{0.001, width - 2.0 * frame, height - 2.0 * frame}}, at(0.0005, 0.0, z), Surface::absorbing);
  addBar(scene, {-0.05, 0.0, z}, {-0.025, 0.0, z}, 0.03);
  return scene;
}

Scene randomKeyboard(CounterRandom& random)
{
  constexpr int rows = 5;
  constexpr double pitch = 0.019, key = 0.016;
  const double width = random.uniform(0.28, 0.34);
  Scene scene;
  scene.beginObject("keyboard");
  scene.add(Box{{rows * pitch + 0.02, width + 0.02, 0.012}}, at(0.0, 0.0, 0.006));
  for (int row = 0; row < rows; ++row)
    scene.add(Box{{key, width, 0.006}}, at((row - 0.5 * (rows - 1)) * pitch, 0.0, 0.015));
  return scene;
}

Scene randomCable(CounterRandom& random)
{
  const double tube = random.uniform(0.002, 0.004);
  const double bend = random.uniform(0.035, 0.055);
  const double half_angle = random.uniform(0.7, 1.2);
  Scene scene;
  scene.beginObject("cable");
  const double step = 2.0 * bend * std::sin(half_angle);
  const double sagitta = bend * std::cos(half_angle);
  for (int i = 0; i < 3; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    scene.add(TorusArc{bend, tube, half_angle},
              at(-side * sagitta, (i - 1) * step, tube) * turned(side > 0.0 ? 0.0 : kPi, Eigen::Vector3d::UnitZ()));
  }
  return scene;
}

Scene randomMarker(CounterRandom& random)
{
  const double radius = random.uniform(0.0075, 0.009);
  Scene scene;
  scene.beginObject("marker");
  addBar(scene, {0.0, -0.068, radius}, {0.0, 0.068, radius}, radius);
  return scene;
}

}  // namespace grasp_affordances
