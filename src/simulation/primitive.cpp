#include "simulation/primitive.h"

#include "simulation/polynomial_roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The part of a ray's line inside a convex solid.
struct Interval
{
  double enter = -kInfinity;
  double exit = kInfinity;

  bool empty() const { return !(enter < exit); }
};

Interval intersection(const Interval& a, const Interval& b)
{
  return {std::max(a.enter, b.enter), std::min(a.exit, b.exit)};
}

constexpr Interval kNowhere{kInfinity, -kInfinity};

/// Where the interval's ends lie after t_min, the first of them.
double firstCrossing(const Interval& inside, double t_min)
{
  if (inside.empty())
    return kNoIntersection;
  if (inside.enter > t_min)
    return inside.enter;
  return inside.exit > t_min ? inside.exit : kNoIntersection;
}

/// -half <= coordinate <= half
Interval slab(double half, double origin, double direction)
{
  if (direction == 0.0)
    return std::abs(origin) <= half ? Interval{} : kNowhere;
  const double a = (-half - origin) / direction;
  const double b = (half - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

/// Where a ray is inside a truncated cone or cylinder without wall.
Interval insideFrustum(double bottom_radius, double top_radius, double height, const Ray& ray)
{
  const Interval between_ends = slab(0.5 * height, ray.origin.z(), ray.direction.z());
  if (between_ends.empty())
    return kNowhere;

  // Inside the double cone where a t^2 + 2 b t + c <= 0; its radius along the ray is radius + widening t.
  const double slope = (top_radius - bottom_radius) / height;
  const double radius = 0.5 * (bottom_radius + top_radius) + slope * ray.origin.z();
  const double widening = slope * ray.direction.z();
  const double a = ray.direction.head<2>().squaredNorm() - widening * widening;
  const double b = ray.origin.head<2>().dot(ray.direction.head<2>()) - radius * widening;
  const double c = ray.origin.head<2>().squaredNorm() - radius * radius;
  if (a == 0.0 && b == 0.0)
    return c <= 0.0 ? between_ends : kNowhere;
  const double discriminant = b * b - a * c;
  if (a >= 0.0 && discriminant < 0.0)
    return kNowhere;

  const double q = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
  const double t1 = q / a;
  const double t2 = q == 0.0 ? t1 : c / q;
  const auto [first, second] = std::minmax(t1, t2);
  if (a >= 0.0)
    return intersection(between_ends, {first, second});
  // The ray is steeper than the cone: it is inside before the first root and after the second, once in each nappe.
  return intersection(between_ends, widening > 0.0 ? Interval{second, kInfinity} : Interval{-kInfinity, first});
}

double firstCrossing(const Box& box, const Ray& ray, double t_min)
{
  Interval inside;
  for (int axis = 0; axis < 3; ++axis)
    inside = intersection(inside, slab(0.5 * box.size[axis], ray.origin[axis], ray.direction[axis]));
  return firstCrossing(inside, t_min);
}

double firstCrossing(const Sphere& sphere, const Ray& ray, double t_min)
{
  const double squared_half_chord = sphere.radius * sphere.radius - ray.origin.squaredNorm();
  if (squared_half_chord <= 0.0)
    return kNoIntersection;
  const double half_chord = std::sqrt(squared_half_chord);
  return firstCrossing(Interval{-half_chord, half_chord}, t_min);
}

double firstCrossing(const Frustum& frustum, const Ray& ray, double t_min)
{
  const Interval outer = insideFrustum(frustum.bottom_radius, frustum.top_radius, frustum.height, ray);
  if (frustum.wall == 0.0)
    return firstCrossing(outer, t_min);
  const Interval bore =
      insideFrustum(frustum.bottom_radius - frustum.wall, frustum.top_radius - frustum.wall, frustum.height, ray);
  if (bore.empty())
    return firstCrossing(outer, t_min);
  return std::min(firstCrossing(Interval{outer.enter, bore.enter}, t_min),
                  firstCrossing(Interval{bore.exit, outer.exit}, t_min));
}

double firstCrossing(const Cylinder& cylinder, const Ray& ray, double t_min)
{
  return firstCrossing(Frustum{cylinder.radius, cylinder.radius, cylinder.height, cylinder.wall}, ray, t_min);
}

bool insideTorusArc(const TorusArc& arc, const Eigen::Vector3d& point)
{
  const double from_tube = std::hypot(std::hypot(point.x(), point.y()) - arc.major_radius, point.z());
  return from_tube <= arc.tube_radius && std::abs(std::atan2(point.y(), point.x())) <= arc.half_angle;
}

/// (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x1^2 + x2^2) is a quartic in t, without cubic term because t counts from the point of
/// the ray's line closest to the origin. Its roots and the planes of the arc's ends cut the line into pieces that are
/// inside or outside as their midpoints are.
double firstCrossing(const TorusArc& arc, const Ray& ray, double t_min)
{
  const double reach = arc.major_radius + arc.tube_radius;
  if (ray.origin.squaredNorm() >= reach * reach)
    return kNoIntersection;

  const auto o = ray.origin.head<2>();
  const auto d = ray.direction.head<2>();
  const double scale = 4.0 * arc.major_radius * arc.major_radius;
  const double k = ray.origin.squaredNorm() + arc.major_radius * arc.major_radius - arc.tube_radius * arc.tube_radius;
  const QuarticRoots roots = depressedQuarticRoots(2.0 * k - scale * d.squaredNorm(), -2.0 * scale * o.dot(d),
                                                   k * k - scale * o.squaredNorm(), -2.0 * reach, 2.0 * reach);
  if (roots.count == 0)
    return kNoIntersection;

  std::array<double, 7> cuts;
  std::size_t count = 0;
  const auto insert = [&](double cut) {
    std::size_t i = count++;
    for (; i > 0 && cuts[i - 1] > cut; --i)
      cuts[i] = cuts[i - 1];
    cuts[i] = cut;
  };
  insert(2.0 * reach);
  for (const double root : roots)
    insert(root);
  for (const double angle : {-arc.half_angle, arc.half_angle}) {
    const Eigen::Vector2d normal(-std::sin(angle), std::cos(angle));
    const double t = -normal.dot(o) / normal.dot(d);
    if (std::abs(t) < reach)
      insert(t);
  }

  bool inside = false;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    const bool next = insideTorusArc(arc, ray.origin + middle * ray.direction);
    if (next != inside && cuts[i] > t_min)
      return cuts[i];
    inside = next;
  }
  return kNoIntersection;
}

template <typename... Handlers>
struct Overloaded : Handlers...
{
  using Handlers::operator()...;
};
template <typename... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

bool positive(double length)
{
  return length > 0.0 && std::isfinite(length);
}

bool isSolid(const Frustum& f)
{
  return positive(f.bottom_radius) && positive(f.top_radius) && positive(f.height) && f.wall >= 0.0 &&
         f.wall < std::min(f.bottom_radius, f.top_radius);
}

bool isSolid(const TorusArc& t)
{
  return positive(t.major_radius) && positive(t.tube_radius) && t.tube_radius < t.major_radius && t.half_angle > 0.0 &&
         t.half_angle <= std::acos(-1.0);
}

}  // namespace

void validate(const Primitive& primitive)
{
  const bool solid = std::visit(
      Overloaded{[](const Box& b) { return positive(b.size.x()) && positive(b.size.y()) && positive(b.size.z()); },
                 [](const Sphere& s) { return positive(s.radius); },
                 [](const Cylinder& c) {
                   return isSolid(Frustum{c.radius, c.radius, c.height, c.wall});
                 },
                 [](const Frustum& f) { return isSolid(f); }, [](const TorusArc& t) { return isSolid(t); }},
      primitive);
  if (!solid)
    throw std::invalid_argument("primitive whose dimensions describe no solid");
}

double boundingRadius(const Primitive& primitive)
{
  return std::visit(
      Overloaded{[](const Box& b) { return 0.5 * b.size.norm(); }, [](const Sphere& s) { return s.radius; },
                 [](const Cylinder& c) { return std::hypot(c.radius, 0.5 * c.height); },
                 [](const Frustum& f) { return std::hypot(std::max(f.bottom_radius, f.top_radius), 0.5 * f.height); },
                 [](const TorusArc& t) { return t.major_radius + t.tube_radius; }},
      primitive);
}

double intersect(const Primitive& primitive, const Ray& ray)
{
  // Unit direction, and t counted from the point closest to the solid's centre: numbers of the solid's own size,
  // however far away the ray starts.
  const double length = ray.direction.norm();
  Ray centred;
  centred.direction = ray.direction / length;
  const double start = ray.origin.dot(centred.direction);
  centred.origin = ray.origin - start * centred.direction;
  const double t = std::visit([&](const auto& solid) { return firstCrossing(solid, centred, start); }, primitive);
  return (t - start) / length;
}

}  // namespace grasp_affordances
