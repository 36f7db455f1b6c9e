#include "simulation/tableware.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

Eigen::Isometry3d at(double x, double y, double z)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace

void add(Scene& scene, const Eigen::Isometry3d& T_scene_mug, const Mug& mug, std::uint32_t handle_label)
{
  scene.add(Cylinder{mug.radius, mug.height, mug.wall}, T_scene_mug * at(0.0, 0.0, 0.5 * mug.height));
  scene.add(Cylinder{mug.radius - 0.5 * mug.wall, mug.floor}, T_scene_mug * at(0.0, 0.0, 0.5 * mug.floor));

  // The arc lies in the xz plane of the mug and ends inside the wall.
  const double centre = mug.radius + mug.handle_clearance + mug.handle_tube_radius - mug.handle_radius;
  const double half_angle = std::acos((mug.radius - 0.5 * mug.wall - centre) / mug.handle_radius);
  const Eigen::AngleAxisd upright(std::acos(0.0), Eigen::Vector3d::UnitX());
  scene.add(TorusArc{mug.handle_radius, mug.handle_tube_radius, half_angle},
            T_scene_mug * at(centre, 0.0, 0.5 * mug.height) * upright, handle_label);
}

void add(Scene& scene, const Eigen::Isometry3d& T_scene_bottle, const Bottle& bottle, std::uint32_t neck_label)
{
  const double shoulder = bottle.body_height;
  const double neck = shoulder + bottle.shoulder_height;
  scene.add(Cylinder{bottle.radius, bottle.body_height}, T_scene_bottle * at(0.0, 0.0, 0.5 * bottle.body_height));
  scene.add(Frustum{bottle.radius, bottle.neck_radius, bottle.shoulder_height},
            T_scene_bottle * at(0.0, 0.0, shoulder + 0.5 * bottle.shoulder_height));
  scene.add(Cylinder{bottle.neck_radius, bottle.neck_length},
            T_scene_bottle * at(0.0, 0.0, neck + 0.5 * bottle.neck_length), neck_label);
}

void add(Scene& scene, const Eigen::Isometry3d& T_scene_bar, const MountedBar& bar, std::uint32_t bar_label)
{
  const Eigen::AngleAxisd z_to_x(std::acos(0.0), Eigen::Vector3d::UnitY());
  scene.add(Cylinder{bar.radius, bar.length}, T_scene_bar * at(0.0, 0.0, bar.axis_height) * z_to_x, bar_label);
  for (const double side : {-1.0, 1.0}) {
    scene.add(Box{{bar.post_width, bar.post_width, bar.post_height}},
              T_scene_bar * at(side * 0.5 * (bar.length + bar.post_width), 0.0, 0.5 * bar.post_height));
  }
}

}  // namespace grasp_affordances
