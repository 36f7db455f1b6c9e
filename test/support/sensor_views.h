#pragma once

#include "simulation/placement.h"
#include "simulation/scene.h"
#include "simulation/sensor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace grasp_affordances::test
{

inline SensorModel exactModel()
{
  SensorModel model;
  model.exact = true;
  return model;
}

inline Frame capture(const View& view, std::uint64_t seed, const SensorModel& model = SensorModel())
{
  return DepthCamera(model).capture(view.scene, view.T_scene_camera, seed);
}

/// A plane through (0, 0, depth) in the camera's frame, faced to the camera and then turned about an axis.
inline View wall(double depth, double angle = 0.0, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitY(),
                 Surface surface = Surface::diffuse)
{
  View view;
  view.scene.add(
      HalfSpace{},
      at(0.0, 0.0, depth) * Eigen::AngleAxisd(angle, axis) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()), surface);
  return view;
}

inline std::size_t measured(const Frame& frame)
{
  return static_cast<std::size_t>(
      std::count_if(frame.depth.begin(), frame.depth.end(), [](std::uint16_t depth) { return depth != 0; }));
}

inline double measuredShare(const Frame& frame)
{
  return static_cast<double>(measured(frame)) / static_cast<double>(frame.depth.size());
}

/// What of a frame is a part.
inline double shareOfPart(const Frame& frame, std::int32_t part)
{
  return static_cast<double>(std::count(frame.parts.begin(), frame.parts.end(), part)) /
         static_cast<double>(frame.parts.size());
}

inline double focalBaseline(const SensorModel& model = SensorModel())
{
  return model.intrinsics.fx * model.projector_x;
}

/// One of each kind, on a table before a wall.
inline View allKinds()
{
  View view;
  Scene& scene = view.scene;
  scene.add(HalfSpace{}, at(0.0, 0.0, 1.6) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
  scene.add(Box{{2.0, 0.03, 1.0}}, at(0.0, 0.25, 1.0));
  const Eigen::AngleAxisd z_up(0.5 * kPi, Eigen::Vector3d::UnitX());
  double x = -0.46;
  for (const Primitive& shape :
       {Primitive(Sphere{0.05}), Primitive(Cylinder{0.04, 0.1, 0.005}), Primitive(Frustum{0.04, 0.02, 0.1}),
        Primitive(TorusArc{0.04, 0.008, 1.4}), Primitive(Ellipsoid{{0.04, 0.03, 0.05}}), Primitive(Capsule{0.02, 0.06}),
        Primitive(EllipticCylinder{0.03, 0.02, 0.08}), Primitive(RoundedBox{{0.05, 0.03, 0.08}, 0.008}),
        Primitive(Oval{0.03, 0.02, 0.08, 0.6}),
        Primitive(Revolution{{{-0.06, 0.03}, {0.0, 0.033}, {0.03, 0.012}, {0.06, 0.013}}})}) {
    scene.add(shape, at(x, 0.1, 0.9) * z_up * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
    x += 0.1;
  }
  scene.add(Sphere{0.1}, at(0.0, -0.1, 0.8), Surface::transparent);
  scene.add(Sphere{0.1}, at(0.6, -0.3, 2.0), Surface::transparent);  // behind the wall
  return view;
}

}  // namespace grasp_affordances::test
