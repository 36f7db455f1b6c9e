#pragma once

#include "simulation/primitive.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <variant>

namespace grasp_affordances::test
{

// Implicit functions of the solids: at most 0 inside, 0 on the surface, and near it a distance up to a factor close
// to 1.

inline double implicit(const Box& box, const Eigen::Vector3d& p)
{
  return (p.cwiseAbs() - 0.5 * box.size).maxCoeff();
}

inline double implicit(const Sphere& sphere, const Eigen::Vector3d& p)
{
  return p.norm() - sphere.radius;
}

inline double implicit(const Frustum& f, const Eigen::Vector3d& p)
{
  const double radius = f.bottom_radius + (f.top_radius - f.bottom_radius) * (p.z() / f.height + 0.5);
  const double from_axis = p.head<2>().norm();
  const double solid = std::max(std::abs(p.z()) - 0.5 * f.height, from_axis - radius);
  return f.wall == 0.0 ? solid : std::max(solid, radius - f.wall - from_axis);
}

inline double implicit(const Cylinder& c, const Eigen::Vector3d& p)
{
  return implicit(Frustum{c.radius, c.radius, c.height, c.wall}, p);
}

inline double implicit(const TorusArc& arc, const Eigen::Vector3d& p)
{
  const double from_axis = p.head<2>().norm();
  const double from_tube = std::hypot(from_axis - arc.major_radius, p.z()) - arc.tube_radius;
  return std::max(from_tube, from_axis * (std::abs(std::atan2(p.y(), p.x())) - arc.half_angle));
}

inline double implicit(const HalfSpace&, const Eigen::Vector3d& p)
{
  return p.z();
}

/// Below the distance by a factor of up to the ratio of the semi-axes.
inline double implicit(const Ellipsoid& e, const Eigen::Vector3d& p)
{
  return (p.cwiseQuotient(e.semi_axes).norm() - 1.0) * e.semi_axes.minCoeff();
}

inline double implicit(const Capsule& c, const Eigen::Vector3d& p)
{
  const double half = 0.5 * c.height;
  return (p - Eigen::Vector3d(0.0, 0.0, std::clamp(p.z(), -half, half))).norm() - c.radius;
}

/// Below the distance by a factor of up to the ratio of the semi-axes.
inline double implicit(const EllipticCylinder& c, const Eigen::Vector3d& p)
{
  const double round =
      (std::hypot(p.x() / c.semi_axis_x, p.y() / c.semi_axis_y) - 1.0) * std::min(c.semi_axis_x, c.semi_axis_y);
  return std::max(std::abs(p.z()) - 0.5 * c.height, round);
}

inline double implicit(const RoundedBox& b, const Eigen::Vector3d& p)
{
  const Eigen::Vector2d beyond =
      p.head<2>().cwiseAbs() - 0.5 * b.size.head<2>() + Eigen::Vector2d::Constant(b.corner_radius);
  const double round = beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff()) - b.corner_radius;
  return std::max(std::abs(p.z()) - 0.5 * b.size.z(), round);
}

/// Below the distance by a factor of up to the ratio of the semi-axes.
inline double implicit(const Oval& o, const Eigen::Vector3d& p)
{
  const double scale = 1.0 + (o.top_scale - 1.0) * (p.z() / o.height + 0.5);
  const double round =
      (std::hypot(p.x() / o.semi_axis_x, p.y() / o.semi_axis_y) - scale) * std::min(o.semi_axis_x, o.semi_axis_y);
  return std::max(std::abs(p.z()) - 0.5 * o.height, round);
}

inline double implicit(const Revolution& r, const Eigen::Vector3d& p)
{
  double nearest = std::max(r.profile.front().z - p.z(), p.z() - r.profile.back().z);
  for (std::size_t i = 0; i + 1 < r.profile.size(); ++i) {
    const auto& [z0, r0] = r.profile[i];
    const auto& [z1, r1] = r.profile[i + 1];
    if (p.z() >= z0 && p.z() <= z1)
      nearest = std::max(nearest, p.head<2>().norm() - (r0 + (r1 - r0) * (p.z() - z0) / (z1 - z0)));
  }
  return nearest;
}

inline double implicit(const Primitive& primitive, const Eigen::Vector3d& p)
{
  return std::visit([&](const auto& solid) { return implicit(solid, p); }, primitive);
}

}  // namespace grasp_affordances::test
