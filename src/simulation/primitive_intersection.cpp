#include "simulation/polynomial_roots.h"
#include "simulation/primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The interval of t in which a ray's line is inside a convex solid.
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

/// The shortest interval that contains both.
Interval hull(const Interval& a, const Interval& b)
{
  return {std::min(a.enter, b.enter), std::max(a.exit, b.exit)};
}

constexpr Interval kNowhere{kInfinity, -kInfinity};

/// The first end of the interval after t_min.
double firstCrossing(const Interval& inside, double t_min)
{
  if (inside.empty())
    return kNoIntersection;
  if (inside.enter > t_min)
    return inside.enter;
  return inside.exit > t_min ? inside.exit : kNoIntersection;
}

/// Where low <= coordinate <= high.
Interval slab(double low, double high, double origin, double direction)
{
  if (direction == 0.0)
    return low <= origin && origin <= high ? Interval{} : kNowhere;
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

/// Where a t^2 + 2 b t + c <= 0, for a >= 0.
Interval insideQuadric(double a, double b, double c)
{
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0)
    return kNowhere;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0.0)
    return c <= 0.0 && a == 0.0 ? Interval{} : kNowhere;
  const auto [first, second] = std::minmax({q / a, c / q});
  return {first, second};
}

/// Where a ray is inside a truncated cone or cylinder between two stations.
Interval insideFrustum(const Revolution::Station& bottom, const Revolution::Station& top, const Ray& ray)
{
  const Interval between_ends = slab(bottom.z, top.z, ray.origin.z(), ray.direction.z());
  if (between_ends.empty())
    return kNowhere;

  // The line is inside the double cone where a t^2 + 2 b t + c <= 0. The cone's radius along the ray is
  // radius + widening * t.
  const double slope = (top.radius - bottom.radius) / (top.z - bottom.z);
  const double middle = 0.5 * (bottom.z + top.z);
  const double radius = 0.5 * (bottom.radius + top.radius) + slope * (ray.origin.z() - middle);
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
  // The ray is steeper than the cone. It is inside before the first root and after the second, each time in another
  // nappe.
  return intersection(between_ends, widening > 0.0 ? Interval{second, kInfinity} : Interval{-kInfinity, first});
}

// These functions return the first crossing after t_min. A ray's direction must be a unit vector. Its origin must be
// the point of its line that is closest to the solid's origin.

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
  const double half = 0.5 * frustum.height;
  const Interval outer = insideFrustum({-half, frustum.bottom_radius}, {half, frustum.top_radius}, ray);
  if (frustum.wall == 0.0 || outer.empty())
    return firstCrossing(outer, t_min);
  const Interval bore =
      insideFrustum({-half, frustum.bottom_radius - frustum.wall}, {half, frustum.top_radius - frustum.wall}, ray);
  if (bore.empty())
    return firstCrossing(outer, t_min);
  return std::min(firstCrossing(Interval{outer.enter, bore.enter}, t_min),
                  firstCrossing(Interval{bore.exit, outer.exit}, t_min));
}

double firstCrossing(const Cylinder& cylinder, const Ray& ray, double t_min)
{
  return firstCrossing(Frustum{cylinder.radius, cylinder.radius, cylinder.height, cylinder.wall}, ray, t_min);
}

/// (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x1^2 + x2^2) is a quartic in t. It has no cubic term, because t = 0 is the point of
/// the line closest to the origin. The roots and the planes of the arc's ends divide the line into pieces. A piece is
/// inside if its midpoint is.
double firstCrossing(const TorusArc& arc, const Ray& ray, double t_min)
{
  const double reach = arc.major_radius + arc.tube_radius;
  const double squared_half_chord = reach * reach - ray.origin.squaredNorm();
  if (squared_half_chord <= 0.0)
    return kNoIntersection;
  const double half_chord = std::sqrt(squared_half_chord);
  const Interval flat = slab(-arc.tube_radius, arc.tube_radius, ray.origin.z(), ray.direction.z());
  if (intersection(flat, {-half_chord, half_chord}).empty())
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
    const bool next = contains(arc, ray.origin + middle * ray.direction);
    if (next != inside && cuts[i] > t_min)
      return cuts[i];
    inside = next;
  }
  return kNoIntersection;
}

double firstCrossing(const Ellipsoid& ellipsoid, const Ray& ray, double t_min)
{
  const Eigen::Vector3d o = ray.origin.cwiseQuotient(ellipsoid.semi_axes);
  const Eigen::Vector3d d = ray.direction.cwiseQuotient(ellipsoid.semi_axes);
  return firstCrossing(insideQuadric(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1.0), t_min);
}

double firstCrossing(const Capsule& capsule, const Ray& ray, double t_min)
{
  const double half = 0.5 * capsule.height;
  Interval inside = insideFrustum({-half, capsule.radius}, {half, capsule.radius}, ray);
  for (const double centre : {-half, half}) {
    const Eigen::Vector3d o(ray.origin.x(), ray.origin.y(), ray.origin.z() - centre);
    const Interval ball = insideQuadric(1.0, o.dot(ray.direction), o.squaredNorm() - capsule.radius * capsule.radius);
    if (!ball.empty())
      inside = inside.empty() ? ball : hull(inside, ball);
  }
  return firstCrossing(inside, t_min);
}

double firstCrossing(const EllipticCylinder& cylinder, const Ray& ray, double t_min)
{
  const Eigen::Vector2d semi_axes(cylinder.semi_axis_x, cylinder.semi_axis_y);
  const Eigen::Vector2d o = ray.origin.head<2>().cwiseQuotient(semi_axes);
  const Eigen::Vector2d d = ray.direction.head<2>().cwiseQuotient(semi_axes);
  const Interval round = insideQuadric(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1.0);
  const double half = 0.5 * cylinder.height;
  return firstCrossing(intersection(round, slab(-half, half, ray.origin.z(), ray.direction.z())), t_min);
}

/// The section is the union of two rectangles and four circles, and it is convex: the line is inside from where it
/// first enters one of them to where it last leaves one.
double firstCrossing(const RoundedBox& box, const Ray& ray, double t_min)
{
  const double radius = box.corner_radius;
  const Eigen::Vector2d half = 0.5 * box.size.head<2>();
  const Eigen::Vector2d straight = half - Eigen::Vector2d::Constant(radius);
  Interval inside = kNowhere;
  const auto include = [&](const Interval& piece) {
    if (!piece.empty())
      inside = hull(inside, piece);
  };
  const auto between = [&](int axis, double limit) {
    return slab(-limit, limit, ray.origin[axis], ray.direction[axis]);
  };
  include(intersection(between(0, half.x()), between(1, straight.y())));
  include(intersection(between(0, straight.x()), between(1, half.y())));
  const double across = ray.direction.head<2>().squaredNorm();
  for (const double x : {-straight.x(), straight.x()}) {
    for (const double y : {-straight.y(), straight.y()}) {
      const Eigen::Vector2d o = ray.origin.head<2>() - Eigen::Vector2d(x, y);
      if (radius > 0.0)
        include(insideQuadric(across, o.dot(ray.direction.head<2>()), o.squaredNorm() - radius * radius));
    }
  }
  return firstCrossing(intersection(inside, between(2, 0.5 * box.size.z())), t_min);
}

/// With y stretched so that the section is round, it is a frustum.
double firstCrossing(const Oval& oval, const Ray& ray, double t_min)
{
  const double half = 0.5 * oval.height;
  const double stretch = oval.semi_axis_x / oval.semi_axis_y;
  Ray stretched = ray;
  stretched.origin.y() *= stretch;
  stretched.direction.y() *= stretch;
  const double top = oval.top_scale * oval.semi_axis_x;
  return firstCrossing(insideFrustum({-half, oval.semi_axis_x}, {half, top}, stretched), t_min);
}

/// The ray passes the pieces in the order of z. Neighbouring pieces have exactly the same t where they meet, so that
/// touching intervals are joined.
double firstCrossing(const Revolution& revolution, const Ray& ray, double t_min)
{
  const auto o = ray.origin.head<2>();
  const auto d = ray.direction.head<2>();
  const double across = d.squaredNorm();
  const double squared_distance_to_axis =
      across > 0.0 ? std::pow(o.x() * d.y() - o.y() * d.x(), 2) / across : o.squaredNorm();

  const auto& profile = revolution.profile;
  const bool ascending = ray.direction.z() >= 0.0;
  Interval inside = kNowhere;
  for (std::size_t piece = 0; piece + 1 < profile.size(); ++piece) {
    const auto& bottom = profile[ascending ? piece : profile.size() - 2 - piece];
    const auto& top = *(&bottom + 1);
    const double radius = std::max(bottom.radius, top.radius);
    if (radius * radius <= squared_distance_to_axis)
      continue;
    const Interval next = insideFrustum(bottom, top, ray);
    if (next.empty())
      continue;
    if (!inside.empty() && next.enter > inside.exit) {
      const double t = firstCrossing(inside, t_min);
      if (t != kNoIntersection)
        return t;
      inside = kNowhere;
    }
    inside = inside.empty() ? next : hull(inside, next);
  }
  return firstCrossing(inside, t_min);
}

/// For solids with round faces.
template <typename Solid>
double firstIntersection(const Solid& solid, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  // A unit direction, and t = 0 at the point closest to the solid's centre. Numbers then have the solid's size, however
  // far away the ray starts.
  const double length = direction.norm();
  Ray centred;
  centred.direction = direction / length;
  const double start = origin.dot(centred.direction);
  centred.origin = origin - start * centred.direction;
  return (firstCrossing(solid, centred, start) - start) / length;
}

double firstIntersection(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  Interval inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * box.size[axis];
    inside = intersection(inside, slab(-half, half, origin[axis], direction[axis]));
  }
  return firstCrossing(inside, 0.0);
}

double firstIntersection(const HalfSpace&, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  return firstCrossing(slab(-kInfinity, 0.0, origin.z(), direction.z()), 0.0);
}

}  // namespace

double intersect(const Primitive& primitive, const Ray& ray)
{
  return std::visit([&](const auto& solid) { return firstIntersection(solid, ray.origin, ray.direction); }, primitive);
}

void intersect(const Primitive& primitive, const Eigen::Vector3d& origin, const Eigen::Vector3d& first_direction,
               const Eigen::Vector3d& step, std::size_t count, double* t)
{
  std::visit(
      [&](const auto& solid) {
        for (std::size_t i = 0; i < count; ++i)
          t[i] = firstIntersection(solid, origin, first_direction + static_cast<double>(i) * step);
      },
      primitive);
}

}  // namespace grasp_affordances
