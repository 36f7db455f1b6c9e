#include "simulation/object_parts.h"

#include "simulation/placement.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

/// Frame of an arc about `centre` whose middle lies in direction x, and whose ends lie towards +y and -y.
Eigen::Isometry3d arcFrame(const Eigen::Vector3d& centre, const Eigen::Vector3d& x, const Eigen::Vector3d& y)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << x, y, x.cross(y);
  T.translation() = centre;
  return T;
}

}  // namespace

void addVessel(Scene& scene, const Eigen::Isometry3d& T_scene_vessel, const Frustum& wall, Surface surface)
{
  scene.add(wall, T_scene_vessel * at(0.0, 0.0, 0.5 * wall.height), surface);
  scene.add(Cylinder{wall.bottom_radius - 0.5 * wall.wall, wall.wall}, T_scene_vessel * at(0.0, 0.0, 0.5 * wall.wall),
            surface);
}

std::size_t addBar(Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, Surface surface)
{
  return scene.add(Cylinder{radius, (to - from).norm()}, halfway(from, to), surface);
}

std::size_t addTaper(Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double from_radius,
                     double to_radius, Surface surface)
{
  return scene.add(Frustum{from_radius, to_radius, (to - from).norm()}, halfway(from, to), surface);
}

std::size_t addBow(Scene& scene, const HandleFeet& feet, double rise, double tube_radius, Surface surface)
{
  const Eigen::Vector3d chord = feet.to - feet.from;
  const double half_chord = 0.5 * chord.norm();
  const double radius = (half_chord * half_chord + rise * rise) / (2.0 * rise);
  const Eigen::Vector3d centre = 0.5 * (feet.from + feet.to) + (rise - radius) * feet.outwards;
  return scene.add(TorusArc{radius, tube_radius, std::atan2(half_chord, radius - rise)},
                   arcFrame(centre, feet.outwards, chord.normalized()), surface);
}

void addStaple(Scene& scene, const HandleFeet& feet, double rise, double corner_radius, double tube_radius,
               Surface surface)
{
  const Eigen::Vector3d along = (feet.to - feet.from).normalized();
  const Eigen::Vector3d leg = (rise - corner_radius) * feet.outwards;
  const auto addCorner = [&](const Eigen::Vector3d& leg_end, const Eigen::Vector3d& inwards) {
    const Eigen::Vector3d middle = (feet.outwards - inwards).normalized();
    const Eigen::Vector3d across = (feet.outwards + inwards).normalized();
    return scene.add(TorusArc{corner_radius, tube_radius, 0.25 * kPi},
                     arcFrame(leg_end + corner_radius * inwards, middle, across), surface);
  };
  const Eigen::Vector3d corner = corner_radius * (feet.outwards + along);
  const Eigen::Vector3d other_corner = corner_radius * (feet.outwards - along);
  const std::size_t from_leg = addBar(scene, feet.from, feet.from + leg, tube_radius, surface);
  const std::size_t from_corner = addCorner(feet.from + leg, along);
  const std::size_t grip = addBar(scene, feet.from + leg + corner, feet.to + leg + other_corner, tube_radius, surface);
  const std::size_t to_corner = addCorner(feet.to + leg, -along);
  const std::size_t to_leg = addBar(scene, feet.to + leg, feet.to, tube_radius, surface);
  scene.join({from_leg, from_corner, grip, to_corner, to_leg});
}

}  // namespace grasp_affordances
