#include "simulation/basic_scenes.h"

#include "simulation/counter_random.h"
#include "simulation/placement.h"
#include "simulation/tableware.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

/// A table seen from one of its long sides. Scene frame: z = 0 is the table's top, y points away from the camera, and
/// the origin is in the middle of the picture.
View viewOfTable(CounterRandom& random)
{
  View view;
  const double yaw = kDegree * random.uniform(-12.0, 12.0);
  view.scene.beginObject("table", Role::support);
  view.scene.add(Box{{1.6, 1.2, 0.03}}, upright(0.0, 0.25, yaw) * Eigen::Translation3d(0.0, 0.0, -0.015));

  const double pitch = kDegree * random.uniform(36.0, 43.0);
  const double distance = random.uniform(0.66, 0.70);
  const Eigen::Vector3d target(0.0, 0.0, 0.04);
  view.T_scene_camera = lookAt(target + distance * Eigen::Vector3d(0.0, -std::cos(pitch), std::sin(pitch)), target);
  return view;
}

View emptyTable(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  return viewOfTable(random);
}

/// Mug and bar in front, bottle and box behind, each in its own area; as laid out here, or mirrored.
View table(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  View view = viewOfTable(random);
  const double mirror = random.coin() ? -1.0 : 1.0;
  const auto place = [&](double x, double y, double yaw) {
    constexpr double slack = 0.012;
    const double dx = random.uniform(-slack, slack);
    const double dy = random.uniform(-slack, slack);
    return upright(mirror * x + dx, y + dy, yaw);
  };

  Mug mug;
  mug.radius = random.uniform(0.038, 0.042);
  mug.height = random.uniform(0.11, 0.12);
  mug.handle_radius = random.uniform(0.041, 0.044);
  mug.handle_tube_radius = random.uniform(0.0076, 0.0082);
  mug.handle_clearance = random.uniform(0.030, 0.033);
  // The mug is seen from the side, and turned towards the camera so far that it does not cover its handle.
  const double line_of_sight = mirror * 20.0 * kDegree;
  const double towards_camera = kDegree * random.uniform(20.0, 40.0);
  const double handle_yaw = random.coin() ? -towards_camera : 180.0 * kDegree + towards_camera;
  add(view.scene, place(-0.18, -0.05, line_of_sight + handle_yaw), mug);

  Bottle bottle;
  bottle.radius = random.uniform(0.0335, 0.0375);
  bottle.body_height = random.uniform(0.115, 0.13);
  bottle.neck_radius = random.uniform(0.0145, 0.016);
  bottle.neck_length = random.uniform(0.056, 0.065);
  add(view.scene, place(-0.05, 0.08, 0.0), bottle);

  MountedBar bar;
  bar.radius = random.uniform(0.0105, 0.0125);
  bar.axis_height = random.uniform(0.062, 0.075);
  add(view.scene, place(0.15, -0.08, kDegree * random.uniform(-15.0, 15.0)), bar);

  const double box_width = random.uniform(0.11, 0.14);
  const double box_depth = random.uniform(0.065, 0.08);
  const double box_height = random.uniform(0.08, 0.12);
  view.scene.beginObject("box");
  view.scene.add(Box{{box_width, box_depth, box_height}}, place(0.2, 0.17, kDegree * random.uniform(-30.0, 30.0)) *
                                                              Eigen::Translation3d(0.0, 0.0, 0.5 * box_height));
  return view;
}

/// A wall behind two plates with a gap between them. The plates fill the rest of the picture, so that the visible strip
/// of the wall looks like a thin bar. Scene frame and camera frame differ by a roll only.
View strip(std::uint64_t seed, Surface plates)
{
  CounterRandom random(seed, RandomStream::placement);
  const double width = random.uniform(0.012, 0.018);
  constexpr double wall_depth = 1.2;
  constexpr double plate_depth = 0.6;
  constexpr double thickness = 0.01;

  View view;
  view.scene.beginObject("wall");
  view.scene.add(Box{{4.0, 4.0, 0.1}}, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, wall_depth + 0.05)));
  // The rays that touch the far edges of the plates bound the strip.
  const Eigen::Vector3d size(0.6, 1.2, thickness);
  const double half_gap = 0.5 * width * (plate_depth + thickness) / wall_depth;
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Translation3d place(side * (half_gap + 0.5 * size.x()), 0.0, plate_depth + 0.5 * thickness);
    view.scene.beginObject("plate");
    view.scene.add(Box{size}, Eigen::Isometry3d(place), plates);
  }
  view.T_scene_camera = Eigen::AngleAxisd(kDegree * random.uniform(-20.0, 20.0), Eigen::Vector3d::UnitZ());
  return view;
}

View shadow(std::uint64_t seed)
{
  return strip(seed, Surface::diffuse);
}

View shadowRemoved(std::uint64_t seed)
{
  return strip(seed, Surface::absorbing);
}

}  // namespace

std::vector<NamedScene> basicScenes()
{
  return {
      {"table", "tests",
       "a mug (handle: label 1), a bottle (neck: 2), a bar between two posts (3) and a box on a table", table},
      {"empty_table", "tests", "a table with nothing on it", emptyTable},
      {"shadow", "tests", "a strip of a wall between two plates before it, which poses as a thin bar", shadow},
      {"shadow_removed", "tests", "the strip of the scene shadow, and nothing else measured", shadowRemoved},
  };
}

}  // namespace grasp_affordances
