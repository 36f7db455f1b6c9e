#include "simulation/primitive.h"

#include "simulation/placement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

bool positive(double length)
{
  return length > 0.0 && std::isfinite(length);
}

bool isSolid(const Box& b)
{
  return positive(b.size.x()) && positive(b.size.y()) && positive(b.size.z());
}

bool isSolid(const Sphere& s)
{
  return positive(s.radius);
}

bool isSolid(const Frustum& f)
{
  return positive(f.bottom_radius) && positive(f.top_radius) && positive(f.height) && f.wall >= 0.0 &&
         f.wall < std::min(f.bottom_radius, f.top_radius);
}

bool isSolid(const Cylinder& c)
{
  return isSolid(Frustum{c.radius, c.radius, c.height, c.wall});
}

bool isSolid(const TorusArc& t)
{
  return positive(t.major_radius) && positive(t.tube_radius) && t.tube_radius < t.major_radius && t.half_angle > 0.0 &&
         t.half_angle <= kPi;
}

bool isSolid(const HalfSpace&)
{
  return true;
}

bool isSolid(const Ellipsoid& e)
{
  return positive(e.semi_axes.x()) && positive(e.semi_axes.y()) && positive(e.semi_axes.z());
}

bool isSolid(const Capsule& c)
{
  return positive(c.radius) && positive(c.height);
}

bool isSolid(const EllipticCylinder& c)
{
  return positive(c.semi_axis_x) && positive(c.semi_axis_y) && positive(c.height);
}

bool isSolid(const RoundedBox& b)
{
  return isSolid(Box{b.size}) && b.corner_radius >= 0.0 && b.corner_radius <= 0.5 * b.size.head<2>().minCoeff();
}

bool isSolid(const Oval& o)
{
  return positive(o.semi_axis_x) && positive(o.semi_axis_y) && positive(o.height) && positive(o.top_scale);
}

bool isSolid(const Revolution& r)
{
  const std::size_t last = r.profile.size() - 1;
  for (std::size_t i = 0; i < r.profile.size(); ++i) {
    const auto& [z, radius] = r.profile[i];
    const bool ascends = i == 0 || z > r.profile[i - 1].z;
    const bool pointed = radius == 0.0 && (i == 0 || i == last);
    if (!std::isfinite(z) || !ascends || !(positive(radius) || pointed))
      return false;
  }
  // A single piece with a radius of 0 at both ends is a line, not a solid.
  return r.profile.size() > 2 || (r.profile.size() == 2 && r.profile[0].radius + r.profile[1].radius > 0.0);
}

double widestRadius(const Revolution& r)
{
  double widest = 0.0;
  for (const Revolution::Station& station : r.profile)
    widest = std::max(widest, station.radius);
  return widest;
}

double reach(const Box& b)
{
  return 0.5 * b.size.norm();
}

double reach(const Sphere& s)
{
  return s.radius;
}

double reach(const Cylinder& c)
{
  return std::hypot(c.radius, 0.5 * c.height);
}

double reach(const Frustum& f)
{
  return std::hypot(std::max(f.bottom_radius, f.top_radius), 0.5 * f.height);
}

double reach(const TorusArc& t)
{
  return t.major_radius + t.tube_radius;
}

double reach(const HalfSpace&)
{
  return std::numeric_limits<double>::infinity();
}

double reach(const Ellipsoid& e)
{
  return e.semi_axes.maxCoeff();
}

double reach(const Capsule& c)
{
  return 0.5 * c.height + c.radius;
}

double reach(const EllipticCylinder& c)
{
  return std::hypot(std::max(c.semi_axis_x, c.semi_axis_y), 0.5 * c.height);
}

double reach(const RoundedBox& b)
{
  return 0.5 * b.size.norm();
}

double reach(const Oval& o)
{
  return std::hypot(std::max(1.0, o.top_scale) * std::max(o.semi_axis_x, o.semi_axis_y), 0.5 * o.height);
}

double reach(const Revolution& r)
{
  double farthest = 0.0;
  for (const Revolution::Station& station : r.profile)
    farthest = std::max(farthest, std::hypot(station.z, station.radius));
  return farthest;
}

Eigen::AlignedBox3d symmetricBox(double x, double y, double z)
{
  return {Eigen::Vector3d(-x, -y, -z), Eigen::Vector3d(x, y, z)};
}

Eigen::AlignedBox3d box(const Box& b)
{
  return {-0.5 * b.size, 0.5 * b.size};
}

Eigen::AlignedBox3d box(const Sphere& s)
{
  return symmetricBox(s.radius, s.radius, s.radius);
}

Eigen::AlignedBox3d box(const Cylinder& c)
{
  return symmetricBox(c.radius, c.radius, 0.5 * c.height);
}

Eigen::AlignedBox3d box(const Frustum& f)
{
  const double radius = std::max(f.bottom_radius, f.top_radius);
  return symmetricBox(radius, radius, 0.5 * f.height);
}

Eigen::AlignedBox3d box(const TorusArc& t)
{
  const double inner = t.major_radius - t.tube_radius;
  const double outer = t.major_radius + t.tube_radius;
  const double cosine = std::cos(t.half_angle);
  const double y = cosine > 0.0 ? outer * std::sin(t.half_angle) : outer;
  return {Eigen::Vector3d((cosine > 0.0 ? inner : outer) * cosine, -y, -t.tube_radius),
          Eigen::Vector3d(outer, y, t.tube_radius)};
}

Eigen::AlignedBox3d box(const HalfSpace&)
{
  const double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::Vector3d(-infinity, -infinity, -infinity), Eigen::Vector3d(infinity, infinity, 0.0)};
}

Eigen::AlignedBox3d box(const Ellipsoid& e)
{
  return {-e.semi_axes, e.semi_axes};
}

Eigen::AlignedBox3d box(const Capsule& c)
{
  return symmetricBox(c.radius, c.radius, 0.5 * c.height + c.radius);
}

Eigen::AlignedBox3d box(const EllipticCylinder& c)
{
  return symmetricBox(c.semi_axis_x, c.semi_axis_y, 0.5 * c.height);
}

Eigen::AlignedBox3d box(const RoundedBox& b)
{
  return box(Box{b.size});
}

Eigen::AlignedBox3d box(const Oval& o)
{
  const double widest = std::max(1.0, o.top_scale);
  return symmetricBox(widest * o.semi_axis_x, widest * o.semi_axis_y, 0.5 * o.height);
}

Eigen::AlignedBox3d box(const Revolution& r)
{
  const double radius = widestRadius(r);
  return {Eigen::Vector3d(-radius, -radius, r.profile.front().z), Eigen::Vector3d(radius, radius, r.profile.back().z)};
}

bool inside(const Box& b, const Eigen::Vector3d& p)
{
  return (p.cwiseAbs() - 0.5 * b.size).maxCoeff() <= 0.0;
}

bool inside(const Sphere& s, const Eigen::Vector3d& p)
{
  return p.squaredNorm() <= s.radius * s.radius;
}

bool inside(const Frustum& f, const Eigen::Vector3d& p)
{
  const double radius = f.bottom_radius + (f.top_radius - f.bottom_radius) * (p.z() / f.height + 0.5);
  const double from_axis = p.head<2>().norm();
  return std::abs(p.z()) <= 0.5 * f.height && from_axis <= radius && (f.wall == 0.0 || from_axis >= radius - f.wall);
}

bool inside(const Cylinder& c, const Eigen::Vector3d& p)
{
  return inside(Frustum{c.radius, c.radius, c.height, c.wall}, p);
}

bool inside(const TorusArc& t, const Eigen::Vector3d& p)
{
  const double from_tube = std::hypot(p.head<2>().norm() - t.major_radius, p.z());
  return from_tube <= t.tube_radius && std::abs(std::atan2(p.y(), p.x())) <= t.half_angle;
}

bool inside(const HalfSpace&, const Eigen::Vector3d& p)
{
  return p.z() <= 0.0;
}

bool inside(const Ellipsoid& e, const Eigen::Vector3d& p)
{
  return p.cwiseQuotient(e.semi_axes).squaredNorm() <= 1.0;
}

bool inside(const Capsule& c, const Eigen::Vector3d& p)
{
  const double beyond = std::max(0.0, std::abs(p.z()) - 0.5 * c.height);
  return p.head<2>().squaredNorm() + beyond * beyond <= c.radius * c.radius;
}

bool inside(const EllipticCylinder& c, const Eigen::Vector3d& p)
{
  return std::abs(p.z()) <= 0.5 * c.height &&
         Eigen::Vector2d(p.x() / c.semi_axis_x, p.y() / c.semi_axis_y).squaredNorm() <= 1.0;
}

bool inside(const RoundedBox& b, const Eigen::Vector3d& p)
{
  const Eigen::Vector2d straight = 0.5 * b.size.head<2>() - Eigen::Vector2d::Constant(b.corner_radius);
  const Eigen::Vector2d into_corner = (p.head<2>().cwiseAbs() - straight).cwiseMax(0.0);
  return inside(Box{b.size}, p) && into_corner.squaredNorm() <= b.corner_radius * b.corner_radius;
}

bool inside(const Oval& o, const Eigen::Vector3d& p)
{
  const double scale = 1.0 + (o.top_scale - 1.0) * (p.z() / o.height + 0.5);
  return std::abs(p.z()) <= 0.5 * o.height &&
         Eigen::Vector2d(p.x() / o.semi_axis_x, p.y() / o.semi_axis_y).norm() <= scale;
}

bool inside(const Revolution& r, const Eigen::Vector3d& p)
{
  if (p.z() < r.profile.front().z || p.z() > r.profile.back().z)
    return false;
  const auto above = std::find_if(r.profile.begin() + 1, r.profile.end() - 1,
                                  [&](const Revolution::Station& station) { return station.z >= p.z(); });
  const auto below = above - 1;
  const double radius = below->radius + (above->radius - below->radius) * (p.z() - below->z) / (above->z - below->z);
  return p.head<2>().norm() <= radius;
}

}  // namespace

void validate(const Primitive& primitive)
{
  if (!std::visit([](const auto& solid) { return isSolid(solid); }, primitive))
    throw std::invalid_argument("primitive whose dimensions describe no solid");
}

double boundingRadius(const Primitive& primitive)
{
  return std::visit([](const auto& solid) { return reach(solid); }, primitive);
}

Eigen::AlignedBox3d boundingBox(const Primitive& primitive)
{
  return std::visit([](const auto& solid) { return box(solid); }, primitive);
}

bool contains(const Primitive& primitive, const Eigen::Vector3d& point)
{
  return std::visit([&](const auto& solid) { return inside(solid, point); }, primitive);
}

}  // namespace grasp_affordances
