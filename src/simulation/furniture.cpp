#include "simulation/furniture.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cstddef>
#include <vector>

namespace grasp_affordances
{
namespace
{

Scene begun(const std::string& name)
{
  Scene scene;
  scene.beginObject(name, Role::background);
  return scene;
}

void addLegs(Scene& scene, double half_depth, double half_width, double height, double radius)
{
  for (const double x : {-half_depth, half_depth}) {
    for (const double y : {-half_width, half_width})
      addBar(scene, {x, y, 0.0}, {x, y, height}, radius);
  }
}

Scene cupboard(CounterRandom& random)
{
  Scene scene = begun("cupboard");
  const Eigen::Vector3d size(random.uniform(0.35, 0.5), random.uniform(0.5, 0.9), random.uniform(0.7, 1.9));
  scene.add(Box{size}, at(0.0, 0.0, 0.5 * size.z()));
  return scene;
}

Scene chair(CounterRandom& random)
{
  constexpr double half_seat = 0.2;
  const double height = random.uniform(0.43, 0.48);
  const double back = random.uniform(0.85, 1.0);
  const double radius = random.uniform(0.009, 0.018);
  Scene scene = begun("chair");
  addLegs(scene, half_seat, half_seat, height, radius);
  scene.add(Box{{2.0 * half_seat + 0.04, 2.0 * half_seat + 0.04, 0.025}}, at(0.0, 0.0, height));
  for (const double y : {-half_seat, half_seat})
    addBar(scene, {-half_seat, y, height}, {-half_seat, y, back}, radius);
  scene.add(Box{{0.02, 2.0 * half_seat, 0.12}}, at(-half_seat, 0.0, back - 0.06));
  return scene;
}

Scene sideTable(CounterRandom& random)
{
  const double height = random.uniform(0.45, 0.75);
  const double half_depth = random.uniform(0.2, 0.3), half_width = random.uniform(0.25, 0.4);
  Scene scene = begun("side table");
  addLegs(scene, half_depth, half_width, height, random.uniform(0.012, 0.03));
  scene.add(Box{{2.0 * half_depth + 0.08, 2.0 * half_width + 0.08, 0.03}}, at(0.0, 0.0, height));
  return scene;
}

Scene floorLamp(CounterRandom& random)
{
  const double height = random.uniform(1.2, 1.6);
  Scene scene = begun("floor lamp");
  scene.add(Cylinder{0.14, 0.03}, at(0.0, 0.0, 0.015));
  addBar(scene, {0.0, 0.0, 0.0}, {0.0, 0.0, height}, random.uniform(0.009, 0.014));
  scene.add(Frustum{0.2, 0.14, 0.25, 0.004}, at(0.0, 0.0, height));
  return scene;
}

Scene clothesRack(CounterRandom& random)
{
  const double half_width = random.uniform(0.35, 0.5);
  const double height = random.uniform(1.1, 1.5);
  const double radius = random.uniform(0.011, 0.016);
  Scene scene = begun("clothes rack");
  for (const double y : {-half_width, half_width}) {
    addBar(scene, {-0.2, y, 0.02}, {0.2, y, 0.02}, radius);
    addBar(scene, {0.0, y, 0.0}, {0.0, y, height}, radius);
  }
  addBar(scene, {0.0, -half_width, height}, {0.0, half_width, height}, radius);
  return scene;
}

}  // namespace

Scene randomFurniture(CounterRandom& random)
{
  using MakeFurniture = Scene (*)(CounterRandom&);
  static const std::vector<MakeFurniture> kinds = {cupboard, chair, chair, sideTable, floorLamp, clothesRack};
  return kinds[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(kinds.size())))](random);
}

}  // namespace grasp_affordances
