#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace grasp_affordances
{

/// The points origin + t * direction with t > 0. The direction has any length but zero.
struct Ray
{
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

// Analytic solids. Each is centred at the origin of its own frame; its axis, if it has one, is z. All lengths in
// metres.

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

/// Arc of a torus about z, from -half_angle to +half_angle. Its middle is on the x axis; its ends are flat.
struct TorusArc
{
  double major_radius;  ///< radius of the tube's centre line, a circle in the xy plane
  double tube_radius;   ///< less than the major radius
  double half_angle;    ///< rad, in (0, pi]; pi: a whole torus
};

/// The half-space below its xy plane: a floor, a table top or a wall.
struct HalfSpace
{
};

struct Ellipsoid
{
  Eigen::Vector3d semi_axes;  ///< along x, y and z
};

/// A cylinder with a hemisphere on either end.
struct Capsule
{
  double radius;
  double height;  ///< of the cylinder, between the centres of the hemispheres
};

struct EllipticCylinder
{
  double semi_axis_x;
  double semi_axis_y;
  double height;
};

/// A bar along z whose section is a rectangle with rounded corners.
struct RoundedBox
{
  Eigen::Vector3d size;  ///< along x, y and z
  double corner_radius;  ///< of the edges along z, at most half the smaller one of the sizes along x and y; 0: sharp
};

/// A bar along z whose section is an ellipse. Both semi-axes change by one factor from the bottom to the top.
struct Oval
{
  double semi_axis_x;  ///< at z = -height / 2
  double semi_axis_y;  ///< at z = -height / 2
  double height;
  double top_scale = 1.0;  ///< semi-axes at z = +height / 2 relative to those at the bottom
};

/// A solid of revolution about z. It consists of the frusta between consecutive stations of its profile.
struct Revolution
{
  struct Station
  {
    double z;
    double radius;  ///< may be 0 at the first and at the last station
  };
  std::vector<Station> profile;  ///< at least two, in order of ascending z
};

using Primitive = std::variant<Box, Sphere, Cylinder, Frustum, TorusArc, HalfSpace, Ellipsoid, Capsule,
                               EllipticCylinder, RoundedBox, Oval, Revolution>;

/// Checks a solid. @throw std::invalid_argument if its dimensions do not describe a solid.
void validate(const Primitive& primitive);

/// Radius of a sphere about the origin that contains the solid; infinite for a half-space.
double boundingRadius(const Primitive& primitive);

/// A box in the solid's frame that contains it; unbounded for a half-space.
Eigen::AlignedBox3d boundingBox(const Primitive& primitive);

constexpr double kNoIntersection = std::numeric_limits<double>::infinity();

/// The smallest t > 0 at which the ray crosses the surface, inwards or outwards; kNoIntersection if it does not. The
/// solid must be valid. The ray must be in the solid's frame.
double intersect(const Primitive& primitive, const Ray& ray);

/// The same for `count` rays from one point, the i-th in the direction first_direction + i * step; writes t[0], ...,
/// t[count - 1].
void intersect(const Primitive& primitive, const Eigen::Vector3d& origin, const Eigen::Vector3d& first_direction,
               const Eigen::Vector3d& step, std::size_t count, double* t);

/// Whether a point, in the solid's frame, is inside its material. The solid must be valid.
bool contains(const Primitive& primitive, const Eigen::Vector3d& point);

}  // namespace grasp_affordances
