#include "simulation/door_scenes.h"

#include "simulation/arrangement.h"
#include "simulation/counter_random.h"
#include "simulation/door_handles.h"
#include "simulation/placement.h"

#include <cmath>
#include <cstddef>

namespace grasp_affordances
{
namespace
{

using MakeHandle = Scene (*)(CounterRandom& random);

/// A front in the plane y = 0, which faces -y. It has its own frame for what is mounted on it: x outwards, y to the
/// right, z up.
struct Panel
{
  double x, z;           ///< m, of its middle
  double width, height;  ///< m
};

constexpr double kThickness = 0.02;  // m, of a panel

void addPanel(Scene& scene, const std::string& name, const Panel& panel)
{
  scene.beginObject(name, Role::front);
  scene.add(Box{{panel.width, kThickness, panel.height}}, at(panel.x, 0.5 * kThickness, panel.z));
}

/// @param angle by which the handle is turned clockwise about the line towards the camera, degrees: 90 makes it upright
void mount(Scene& scene, const Scene& handle, double x, double z, double angle)
{
  const Eigen::Isometry3d T_scene_front = at(x, 0.0, z) * turned(-90.0 * kDegree, Eigen::Vector3d::UnitZ());
  append(handle, T_scene_front * turned(kDegree * angle, Eigen::Vector3d::UnitX()), scene);
}

MakeHandle draw(CounterRandom& random, const std::vector<MakeHandle>& kinds)
{
  return kinds[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(kinds.size())))];
}

/// A floor below, a wall behind, and a camera before the origin.
View beforeFronts(CounterRandom& random, double min_distance, double max_distance)
{
  View view;
  view.scene.beginObject("floor", Role::floor);
  view.scene.add(HalfSpace{}, at(0.0, 0.0, -0.8));
  view.scene.beginObject("wall", Role::wall);
  view.scene.add(HalfSpace{}, at(0.0, 0.4, 0.0) * turned(90.0 * kDegree, Eigen::Vector3d::UnitX()));
  const double elevation = kDegree * random.uniform(0.0, 35.0);
  const double azimuth = kDegree * random.uniform(-30.0, 30.0);
  const double distance = random.uniform(min_distance, max_distance);
  const Eigen::Vector3d towards_camera(std::cos(elevation) * std::sin(azimuth),
                                       -std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
  view.T_scene_camera = lookAt(distance * towards_camera, Eigen::Vector3d::Zero());
  return view;
}

/// Two drawers above two doors.
View cupboard(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  View view = beforeFronts(random, 0.65, 1.2);
  Scene& scene = view.scene;
  const double width = random.uniform(0.28, 0.36);
  const double door_height = random.uniform(0.36, 0.44), drawer_height = random.uniform(0.13, 0.16);
  constexpr double gap = 0.004;
  const double height = door_height + gap + drawer_height;
  const double drawer_z = 0.5 * (height - drawer_height), door_z = -0.5 * (height - door_height);
  const MakeHandle of_drawers = draw(random, {randomBarHandle, randomBowHandle, randomStapleHandle, randomKnob});
  const MakeHandle of_doors = draw(random, {randomBarHandle, randomBowHandle, randomStapleHandle, randomKnob});
  scene.beginObject("cupboard", Role::front);
  scene.add(Box{{2.0 * width, 0.3, height}}, at(0.0, kThickness + 0.15, 0.0));
  for (const double side : {-1.0, 1.0}) {
    const double x = 0.5 * side * (width + gap);
    addPanel(scene, "drawer", {x, drawer_z, width, drawer_height});
    addPanel(scene, "door", {x, door_z, width, door_height});
    mount(scene, of_drawers(random), x, drawer_z, 0.0);
    mount(scene, of_doors(random), side * 0.045, door_z + 0.5 * door_height - 0.13, 90.0);
  }
  return view;
}

/// An oven with knobs above its handle, beside a refrigerator with an upright one.
View appliances(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  View view = beforeFronts(random, 0.9, 1.5);
  Scene& scene = view.scene;
  const double side = random.coin() ? 1.0 : -1.0;
  constexpr double oven_width = 0.55, refrigerator_width = 0.5;
  const double oven_x = -0.28 * side, refrigerator_x = 0.26 * side;
  addPanel(scene, "oven", {oven_x, -0.12, oven_width, 0.42});
  addPanel(scene, "control panel", {oven_x, 0.16, oven_width, 0.12});
  addPanel(scene, "refrigerator", {refrigerator_x, 0.0, refrigerator_width, 0.8});
  mount(scene, randomApplianceHandle(random), oven_x, 0.05, 0.0);
  for (const double x : {-0.18, -0.06, 0.06, 0.18})
    mount(scene, randomControlKnob(random), oven_x + x, 0.16, 0.0);
  mount(scene, randomApplianceHandle(random), refrigerator_x - side * 0.2, random.uniform(-0.05, 0.05), 90.0);
  return view;
}

/// The middle of a room's door.
View roomDoor(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  View view = beforeFronts(random, 0.58, 1.0);
  Scene& scene = view.scene;
  const double side = random.coin() ? 1.0 : -1.0;
  addPanel(scene, "door", {-0.34 * side, 0.0, 0.8, 1.3});
  const double kind = random.uniform();
  if (kind < 0.5)
    mount(scene, randomLever(random), 0.0, 0.0, side > 0.0 ? 180.0 : 0.0);
  else if (kind < 0.75)
    mount(scene, randomKnob(random), 0.0, 0.0, 0.0);
  else
    mount(scene, randomApplianceHandle(random), 0.0, 0.0, 90.0);
  mount(scene, randomBarHandle(random), -0.2 * side, random.uniform(-0.08, 0.08), 90.0);
  return view;
}

}  // namespace

std::vector<NamedScene> doorScenes()
{
  return {
      {"doors1", "doors", "a cupboard: two drawers above two doors, with bar, bow or staple handles or knobs",
       cupboard},
      {"doors2", "doors", "an oven with control knobs beside a refrigerator, with long handles", appliances},
      {"doors3", "doors", "a room's door with a lever, a knob or a long bar, and a second bar", roomDoor},
  };
}

}  // namespace grasp_affordances
