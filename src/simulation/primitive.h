#pragma once

#include <Eigen/Core>

#include <limits>
#include <variant>

namespace grasp_affordances
{

/// The points origin + t direction with t > 0. The direction has any length but zero.
struct Ray
{
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

// Analytic solids, each centred at the origin of its own frame; what has an axis has it along z. Metres.

struct Box
{
  Eigen::Vector3d size;  ///< along x, y and z
};

struct Sphere
{
  double radius;
};

struct Cylinder
{
  double radius;
  double height;
  double wall = 0.0;  ///< thickness of the wall of an open tube; 0: a solid cylinder
};

struct Frustum
{
  double bottom_radius;  ///< at z = -height / 2
  double top_radius;     ///< at z = +height / 2
  double height;
  double wall = 0.0;  ///< thickness, measured horizontally, of the wall of an open tube; 0: a solid frustum
};

/// Arc of a torus, from -half_angle to +half_angle about z, with its middle on the x axis and flat ends.
struct TorusArc
{
  double major_radius;  ///< of the circle in the xy plane that the tube follows
  double tube_radius;   ///< less than the major radius
  double half_angle;    ///< rad, in (0, pi]; pi: a whole torus
};

using Primitive = std::variant<Box, Sphere, Cylinder, Frustum, TorusArc>;

/// @throw std::invalid_argument for dimensions that describe no solid.
void validate(const Primitive& primitive);

/// Radius of the smallest sphere about the origin that is known to hold the solid.
double boundingRadius(const Primitive& primitive);

constexpr double kNoIntersection = std::numeric_limits<double>::infinity();

/// The smallest t > 0 at which the ray crosses the surface, inwards or outwards; kNoIntersection where there is none.
/// The solid must be valid, and the ray in its frame.
double intersect(const Primitive& primitive, const Ray& ray);

}  // namespace grasp_affordances
