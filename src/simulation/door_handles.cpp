#include "simulation/door_handles.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cstddef>

namespace grasp_affordances
{
namespace
{

double roomForFinger(CounterRandom& random)
{
  return random.uniform(0.025, 0.05);
}

/// Joins a bar along y to posts at its ends: a hand that is on them is on the handle.
/// @param half_depth of the bar along x
void joinPosts(Scene& scene, std::size_t bar, double x, double half_length, double half_depth)
{
  const auto post = [&](double y) { return addBar(scene, {0.0, y, 0.0}, {x - half_depth, y, 0.0}, 0.5 * half_depth); };
  const double y = half_length - half_depth;
  scene.join({post(-y), bar, post(y)});
}

/// Frame whose z axis is the plane's y axis, and whose x axis stands out of the plane.
Eigen::Isometry3d alongPlane(double x, double y)
{
  return at(x, y, 0.0) * turned(-90.0 * kDegree, Eigen::Vector3d::UnitX());
}

}  // namespace

Scene randomBarHandle(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("bar handle");
  const bool fits = random.uniform() < 0.8;
  const double room = fits ? roomForFinger(random) : random.uniform(0.002, 0.0035);
  const double radius = random.uniform(0.005, 0.008);
  const double half_length = random.uniform(0.05, 0.09);
  const double x = room + radius;
  const std::size_t bar = addBar(scene, {x, -half_length, 0.0}, {x, half_length, 0.0}, radius);
  joinPosts(scene, bar, x, half_length, radius);
  return scene;
}

Scene randomBowHandle(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("bow handle");
  const double tube = random.uniform(0.005, 0.008);
  const double half_length = random.uniform(0.05, 0.075);
  const HandleFeet feet{{0.0, -half_length, 0.0}, {0.0, half_length, 0.0}, Eigen::Vector3d::UnitX()};
  addBow(scene, feet, roomForFinger(random) + tube, tube);
  return scene;
}

Scene randomStapleHandle(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("staple handle");
  const double tube = random.uniform(0.005, 0.007);
  const double half_length = random.uniform(0.048, 0.08);
  const HandleFeet feet{{0.0, -half_length, 0.0}, {0.0, half_length, 0.0}, Eigen::Vector3d::UnitX()};
  addStaple(scene, feet, roomForFinger(random) + tube, 0.012, tube);
  return scene;
}

Scene randomKnob(CounterRandom& random)
{
  const double stem = random.uniform(0.008, 0.011);
  const double stem_length = random.uniform(0.01, 0.018);
  const double radius = random.uniform(0.019, 0.032);
  const double thickness = random.uniform(0.026, 0.032);
  Scene scene;
  scene.beginObject("knob");
  scene.add(Revolution{{{0.0, stem},
                        {stem_length, stem},
                        {stem_length + 0.2 * thickness, 0.8 * radius},
                        {stem_length + 0.45 * thickness, radius},
                        {stem_length + 0.75 * thickness, 0.92 * radius},
                        {stem_length + thickness, 0.5 * radius}}},
            turned(90.0 * kDegree, Eigen::Vector3d::UnitY()));
  return scene;
}

Scene randomLever(CounterRandom& random)
{
  const double room = random.uniform(0.03, 0.05);
  const double radius = random.uniform(0.008, 0.0105);
  const double length = random.uniform(0.11, 0.13);
  const double x = room + radius;
  Scene scene;
  scene.beginObject("lever");
  addBar(scene, {0.0, 0.0, 0.0}, {0.008, 0.0, 0.0}, 0.025);
  const std::size_t stem = addBar(scene, {0.008, 0.0, 0.0}, {x - radius, 0.0, 0.0}, 0.6 * radius);
  const double end = length - radius;
  const std::size_t lever =
      random.coin() ? addBar(scene, {x, -radius, 0.0}, {x, end, 0.0}, radius)
                    : scene.add(Oval{radius, 1.4 * radius, length, 0.85}, alongPlane(x, 0.5 * (end - radius)));
  scene.join({stem, lever});
  return scene;
}

Scene randomApplianceHandle(CounterRandom& random)
{
  const double room = random.uniform(0.03, 0.05);
  const double radius = random.uniform(0.009, 0.012);
  const double half_length = random.uniform(0.15, 0.23);
  const double x = room + radius;
  Scene scene;
  scene.beginObject("appliance handle");
  const double kind = random.uniform();
  std::size_t bar = 0;
  if (kind < 0.4)
    bar = addBar(scene, {x, -half_length, 0.0}, {x, half_length, 0.0}, radius);
  else if (kind < 0.7)
    bar = scene.add(Oval{radius, 1.5 * radius, 2.0 * half_length}, alongPlane(x, 0.0));
  else
    bar = scene.add(RoundedBox{{2.0 * radius, 2.6 * radius, 2.0 * half_length}, 0.4 * radius}, alongPlane(x, 0.0));
  joinPosts(scene, bar, x, half_length, radius);
  return scene;
}

Scene randomControlKnob(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("control knob");
  scene.add(Frustum{random.uniform(0.018, 0.021), 0.017, 0.02},
            turned(90.0 * kDegree, Eigen::Vector3d::UnitY()) * at(0.0, 0.0, 0.01));
  return scene;
}

}  // namespace grasp_affordances
