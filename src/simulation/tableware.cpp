#include "simulation/tableware.h"

#include "simulation/object_parts.h"
#include "simulation/placement.h"

#include <cmath>

namespace grasp_affordances
{

void add(Scene& scene, const Eigen::Isometry3d& T_scene_mug, const Mug& mug)
{
  scene.beginObject("mug");
  scene.add(Cylinder{mug.radius, mug.height, mug.wall}, T_scene_mug * at(0.0, 0.0, 0.5 * mug.height));
  scene.add(Cylinder{mug.radius - 0.5 * mug.wall, mug.floor}, T_scene_mug * at(0.0, 0.0, 0.5 * mug.floor));

  // The arc lies in the xz plane of the mug and ends inside the wall.
  const double centre = mug.radius + mug.handle_clearance + mug.handle_tube_radius - mug.handle_radius;
  const double half_angle = std::acos((mug.radius - 0.5 * mug.wall - centre) / mug.handle_radius);
  const Eigen::AngleAxisd upright(std::acos(0.0), Eigen::Vector3d::UnitX());
  scene.add(TorusArc{mug.handle_radius, mug.handle_tube_radius, half_angle},
            T_scene_mug * at(centre, 0.0, 0.5 * mug.height) * upright);
}

void add(Scene& scene, const Eigen::Isometry3d& T_scene_bottle, const Bottle& bottle)
{
  const double shoulder_z = bottle.body_height;
  const double neck_z = shoulder_z + bottle.shoulder_height;
  scene.beginObject("bottle");
  scene.add(Cylinder{bottle.radius, bottle.body_height}, T_scene_bottle * at(0.0, 0.0, 0.5 * bottle.body_height));
  const std::size_t shoulder = scene.add(Frustum{bottle.radius, bottle.neck_radius, bottle.shoulder_height},
                                         T_scene_bottle * at(0.0, 0.0, shoulder_z + 0.5 * bottle.shoulder_height));
  const std::size_t neck = scene.add(Cylinder{bottle.neck_radius, bottle.neck_length},
                                     T_scene_bottle * at(0.0, 0.0, neck_z + 0.5 * bottle.neck_length));
  scene.join({shoulder, neck});
}

void add(Scene& scene, const Eigen::Isometry3d& T_scene_bar, const MountedBar& bar)
{
  scene.beginObject("bar");
  const Eigen::AngleAxisd z_to_x(std::acos(0.0), Eigen::Vector3d::UnitY());
  scene.add(Cylinder{bar.radius, bar.length}, T_scene_bar * at(0.0, 0.0, bar.axis_height) * z_to_x);
  for (const double side : {-1.0, 1.0}) {
    scene.add(Box{{bar.post_width, bar.post_width, bar.post_height}},
              T_scene_bar * at(side * 0.5 * (bar.length + bar.post_width), 0.0, 0.5 * bar.post_height));
  }
}

Scene randomMug(CounterRandom& random)
{
  Mug mug;
  mug.radius = random.uniform(0.036, 0.044);
  mug.handle_radius = random.uniform(0.034, 0.042);
  mug.handle_tube_radius = random.uniform(0.0068, 0.0085);
  // The arc is about half a circle.
  mug.handle_clearance = mug.handle_radius - mug.handle_tube_radius - random.uniform(0.0, 0.004);
  mug.height = 2.0 * (mug.handle_radius + mug.handle_tube_radius) + random.uniform(0.006, 0.025);
  Scene scene;
  add(scene, Eigen::Isometry3d::Identity(), mug);
  return scene;
}

Scene randomDressingBottle(CounterRandom& random)
{
  const double body = random.uniform(0.030, 0.035);
  const double neck = random.uniform(0.0135, 0.016);
  const double cap = neck + random.uniform(0.002, 0.004);
  const double shoulder_z = random.uniform(0.11, 0.135);
  const double neck_z = shoulder_z + random.uniform(0.03, 0.04);
  const double cap_z = neck_z + random.uniform(0.03, 0.045);
  Scene scene;
  scene.beginObject("salad dressing bottle");
  scene.add(
      Revolution{
          {{0.0, body}, {shoulder_z, body}, {neck_z, neck}, {cap_z, neck}, {cap_z + 0.001, cap}, {cap_z + 0.022, cap}}},
      Eigen::Isometry3d::Identity());
  return scene;
}

Scene randomFrenchPress(CounterRandom& random)
{
  const double radius = random.uniform(0.045, 0.05);
  const double height = random.uniform(0.15, 0.165);
  const double base = 0.012;
  constexpr double glass = 0.003;
  constexpr double strip = 0.002;
  Scene scene;
  scene.beginObject("French press");
  scene.add(Cylinder{radius, height - base, glass}, at(0.0, 0.0, 0.5 * (height + base)), Surface::transparent);
  scene.add(Cylinder{radius + strip, base}, at(0.0, 0.0, 0.5 * base), Surface::shiny);
  for (const double z : {0.3 * height, height - 0.008})
    scene.add(Cylinder{radius + strip, 0.012, strip}, at(0.0, 0.0, z), Surface::shiny);
  for (const double angle : {0.0, 0.5 * kPi, kPi, 1.5 * kPi}) {
    scene.add(Box{{strip, 0.012, height}},
              turned(angle, Eigen::Vector3d::UnitZ()) * at(radius + 0.5 * strip, 0.0, 0.5 * height), Surface::shiny);
  }
  scene.add(Cylinder{radius + 0.001, 0.014}, at(0.0, 0.0, height + 0.007), Surface::dark);
  scene.add(Cylinder{0.004, 0.006}, at(0.0, 0.0, height + 0.017), Surface::shiny);
  scene.add(Sphere{0.01}, at(0.0, 0.0, height + 0.028), Surface::dark);

  const HandleFeet feet{{radius, 0.0, 0.03}, {radius, 0.0, height - 0.02}, Eigen::Vector3d::UnitX()};
  const double tube_radius = random.uniform(0.008, 0.010);
  const double rise = random.uniform(0.04, 0.045);
  addStaple(scene, feet, rise, 0.02, tube_radius, Surface::dark);
  return scene;
}

Scene randomKettle(CounterRandom& random)
{
  const double radius = random.uniform(0.082, 0.092);
  const double lid_z = random.uniform(0.115, 0.13);
  const double knob_z = lid_z + 0.006;
  Scene scene;
  scene.beginObject("tea kettle");
  scene.add(Revolution{{{0.0, radius - 0.008},
                        {0.02, radius},
                        {0.06, radius - 0.003},
                        {lid_z - 0.02, 0.068},
                        {lid_z, 0.045},
                        {knob_z - 0.0005, 0.042},
                        {knob_z, 0.010},
                        {knob_z + 0.016, 0.012},
                        {knob_z + 0.02, 0.004}}},
            Eigen::Isometry3d::Identity(), Surface::shiny);
  addTaper(scene, {0.055, 0.0, 0.05}, {radius + 0.022, 0.0, 0.095}, 0.024, 0.016, Surface::shiny);
  const HandleFeet feet{{-0.066, 0.0, lid_z - 0.022}, {0.066, 0.0, lid_z - 0.022}, Eigen::Vector3d::UnitZ()};
  const double tube_radius = random.uniform(0.009, 0.0115);
  const double rise = random.uniform(0.11, 0.125);
  addBow(scene, feet, rise, tube_radius);
  return scene;
}

namespace
{

/// A vessel with one long handle.
Scene stemmedVessel(const char* name, const Frustum& vessel, double handle_z, double pitch, double length,
                    double handle_radius)
{
  Scene scene;
  scene.beginObject(name);
  addVessel(scene, Eigen::Isometry3d::Identity(), vessel, Surface::dark);
  const double slope = (vessel.top_radius - vessel.bottom_radius) / vessel.height;
  const Eigen::Vector3d root(vessel.bottom_radius + slope * handle_z - vessel.wall, 0.0, handle_z);
  addTaper(scene, root, root + length * Eigen::Vector3d(std::cos(pitch), 0.0, std::sin(pitch)), handle_radius - 0.002,
           handle_radius);
  return scene;
}

}  // namespace

Scene randomPot(CounterRandom& random)
{
  const double radius = random.uniform(0.08, 0.095);
  const double height = random.uniform(0.08, 0.10);
  const double handle_radius = random.uniform(0.0115, 0.0135);
  const double length = random.uniform(0.14, 0.17);
  const double pitch = kDegree * random.uniform(3.0, 10.0);
  return stemmedVessel("pot", {radius, radius, height, 0.004}, height - 0.02, pitch, length, handle_radius);
}

Scene randomPan(CounterRandom& random)
{
  const double radius = random.uniform(0.095, 0.115);
  const double height = random.uniform(0.045, 0.055);
  const double handle_radius = random.uniform(0.0115, 0.0135);
  const double length = random.uniform(0.16, 0.19);
  const double pitch = kDegree * random.uniform(12.0, 20.0);
  return stemmedVessel("pan", {radius, radius + 0.02, height, 0.004}, height - 0.016, pitch, length, handle_radius);
}

Scene randomRollingPin(CounterRandom& random)
{
  const double radius = random.uniform(0.029, 0.032);
  const double body = 0.5 * random.uniform(0.2, 0.24);
  const double handle = random.uniform(0.012, 0.0135);
  const double length = random.uniform(0.085, 0.1);
  Scene scene;
  scene.beginObject("rolling pin");
  const double end = body + length;
  scene.add(Revolution{{{-end, handle - 0.003},
                        {-end + 0.01, handle},
                        {-body - 0.0005, handle - 0.001},
                        {-body, radius},
                        {body, radius},
                        {body + 0.0005, handle - 0.001},
                        {end - 0.01, handle},
                        {end, handle - 0.003}}},
            at(0.0, 0.0, radius) * turned(0.5 * kPi, Eigen::Vector3d::UnitY()));
  return scene;
}

Scene randomBowlWithLadle(CounterRandom& random)
{
  const Frustum bowl{random.uniform(0.05, 0.055), random.uniform(0.085, 0.095), random.uniform(0.06, 0.075), 0.004};
  const double stick = random.uniform(0.0065, 0.008);
  const double length = random.uniform(0.23, 0.27);
  constexpr double ladle_radius = 0.028;
  Scene scene;
  scene.beginObject("bowl");
  addVessel(scene, Eigen::Isometry3d::Identity(), bowl);

  // The stick starts above the bowl's floor and passes just above the rim.
  const Eigen::Vector3d start(0.0, 0.0, bowl.wall + 0.026);
  const Eigen::Vector3d rim(bowl.top_radius - bowl.wall, 0.0, bowl.height);
  const Eigen::Vector3d to_rim = rim - start;
  const double pitch = std::atan2(to_rim.z(), to_rim.x()) + std::asin((stick + 0.001) / to_rim.norm());
  const Eigen::Vector3d direction(std::cos(pitch), 0.0, std::sin(pitch));
  scene.beginObject("ladle");
  addVessel(scene, at(start.x() - ladle_radius + 0.004, 0.0, bowl.wall + 0.002),
            {0.7 * ladle_radius, ladle_radius, 0.028, 0.003}, Surface::shiny);
  addBar(scene, start, start + length * direction, stick);
  return scene;
}

Scene randomBowl(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("bowl");
  addVessel(scene, Eigen::Isometry3d::Identity(),
            {random.uniform(0.045, 0.06), random.uniform(0.075, 0.1), random.uniform(0.05, 0.075), 0.004});
  return scene;
}

Scene randomPlate(CounterRandom& random)
{
  const double radius = random.uniform(0.1, 0.125);
  Scene scene;
  scene.beginObject("plate");
  addVessel(scene, Eigen::Isometry3d::Identity(), {0.65 * radius, radius, random.uniform(0.018, 0.024), 0.005});
  return scene;
}

Scene randomCup(CounterRandom& random)
{
  Scene scene;
  scene.beginObject("cup");
  addVessel(scene, Eigen::Isometry3d::Identity(),
            {random.uniform(0.031, 0.034), random.uniform(0.041, 0.045), random.uniform(0.08, 0.1), 0.003});
  return scene;
}

Scene randomCan(CounterRandom& random)
{
  const double height = random.uniform(0.1, 0.12);
  Scene scene;
  scene.beginObject("can");
  scene.add(Cylinder{random.uniform(0.032, 0.04), height}, at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomLyingCan(CounterRandom& random)
{
  const double radius = random.uniform(0.0325, 0.0335);
  Scene scene;
  scene.beginObject("lying can");
  scene.add(Cylinder{radius, random.uniform(0.1, 0.12)},
            at(0.0, 0.0, radius) * turned(0.5 * kPi, Eigen::Vector3d::UnitX()));
  return scene;
}

}  // namespace grasp_affordances
