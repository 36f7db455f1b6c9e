#include "simulation/grip_axis.h"

#include "simulation/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace grasp_affordances
{
namespace
{

using Axes = std::vector<GripAxis>;
constexpr auto kElliptic = GripAxis::Section::elliptic;

/// Half the length of a circle's chord at a distance from the centre.
double halfChord(double radius, double distance)
{
  return std::sqrt(std::max(0.0, radius * radius - distance * distance));
}

/// Frame whose z, x and y axes are the axes k, k + 1 and k + 2, modulo 3.
Eigen::Isometry3d frameOfAxis(int k)
{
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << Eigen::Vector3d::Unit((k + 1) % 3), Eigen::Vector3d::Unit((k + 2) % 3), Eigen::Vector3d::Unit(k);
  return frame;
}

Eigen::Vector2d acrossAxis(const Eigen::Vector3d& sizes, int k)
{
  return {sizes[(k + 1) % 3], sizes[(k + 2) % 3]};
}

std::array<int, 3> longestFirst(const Eigen::Vector3d& sizes)
{
  std::array<int, 3> order{2, 0, 1};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sizes[a] > sizes[b]; });
  return order;
}

/// Distance from the middle of a rounded rectangle to its outline: to a straight side, or else to a corner's circle.
double roundedOutlineRadius(const Eigen::Vector2d& half_sizes, double corner_radius, const Eigen::Vector2d& direction)
{
  const Eigen::Vector2d unit = direction.cwiseAbs().normalized();
  const Eigen::Vector2d corner = half_sizes - Eigen::Vector2d::Constant(corner_radius);
  const double to_side = 1.0 / unit.cwiseQuotient(half_sizes).maxCoeff();
  const Eigen::Vector2d on_side = to_side * unit;
  if (on_side.x() <= corner.x() || on_side.y() <= corner.y())
    return to_side;
  const double along = corner.dot(unit);
  return along + halfChord(corner_radius, std::sqrt(std::max(0.0, corner.squaredNorm() - along * along)));
}

/// An axis along z with round sections. Radii are interpolated between stations.
Axes axes(const Revolution& solid, const Eigen::Matrix3d&)
{
  const std::vector<Revolution::Station>& profile = solid.profile;
  const double bottom = profile.front().z, top = profile.back().z;
  const double middle = 0.5 * (bottom + top);
  std::vector<double> peaks;
  for (const Revolution::Station& station : profile)
    peaks.push_back(station.z - middle);
  const auto radius = [profile, middle](double z) {
    std::size_t i = 1;
    while (i + 1 < profile.size() && profile[i].z < z + middle)
      ++i;
    const double share = (z + middle - profile[i - 1].z) / (profile[i].z - profile[i - 1].z);
    return profile[i - 1].radius + share * (profile[i].radius - profile[i - 1].radius);
  };
  const Eigen::Isometry3d T_shape_axis(Eigen::Translation3d(0.0, 0.0, middle));
  return {GripAxis::straight(T_shape_axis, top - bottom, kElliptic, Eigen::Vector2d::Ones(), radius, peaks)};
}

Axes axes(const Frustum& f, const Eigen::Matrix3d&)
{
  const auto radius = [f](double z) {
    return f.bottom_radius + (f.top_radius - f.bottom_radius) * (z / f.height + 0.5);
  };
  return {GripAxis::straight(Eigen::Isometry3d::Identity(), f.height, kElliptic, Eigen::Vector2d::Ones(), radius)};
}

Axes axes(const EllipticCylinder& c, const Eigen::Matrix3d&)
{
  return {GripAxis::straight(Eigen::Isometry3d::Identity(), c.height, kElliptic, {c.semi_axis_x, c.semi_axis_y})};
}

Axes axes(const Cylinder& c, const Eigen::Matrix3d& R_scene_shape)
{
  return axes(EllipticCylinder{c.radius, c.radius, c.height}, R_scene_shape);
}

Axes axes(const Capsule& c, const Eigen::Matrix3d&)
{
  const auto radius = [c](double z) { return halfChord(c.radius, std::max(0.0, std::abs(z) - 0.5 * c.height)); };
  return {GripAxis::straight(Eigen::Isometry3d::Identity(), c.height + 2.0 * c.radius, kElliptic,
                             Eigen::Vector2d::Ones(), radius, {0.0})};
}

Axes axes(const Sphere& s, const Eigen::Matrix3d& R_scene_shape)
{
  const auto radius = [s](double z) { return halfChord(s.radius, z); };
  Axes result;
  for (const int k : {2, 0, 1}) {
    result.push_back(GripAxis::straight(frameAlong(R_scene_shape.row(k).transpose()), 2.0 * s.radius, kElliptic,
                                        Eigen::Vector2d::Ones(), radius, {0.0}));
  }
  return result;
}

Axes axes(const Ellipsoid& e, const Eigen::Matrix3d&)
{
  Axes result;
  for (const int k : longestFirst(e.semi_axes)) {
    const double semi_axis = e.semi_axes[k];
    const auto scale = [semi_axis](double z) { return halfChord(1.0, z / semi_axis); };
    result.push_back(
        GripAxis::straight(frameOfAxis(k), 2.0 * semi_axis, kElliptic, acrossAxis(e.semi_axes, k), scale, {0.0}));
  }
  return result;
}

Axes axes(const Box& b, const Eigen::Matrix3d&)
{
  Axes result;
  for (const int k : longestFirst(b.size)) {
    result.push_back(
        GripAxis::straight(frameOfAxis(k), b.size[k], GripAxis::Section::rectangular, 0.5 * acrossAxis(b.size, k)));
  }
  return result;
}

Axes axes(const RoundedBox& b, const Eigen::Matrix3d&)
{
  return {GripAxis::along(b)};
}

Axes axes(const Oval& o, const Eigen::Matrix3d&)
{
  const auto scale = [o](double z) { return 1.0 + (o.top_scale - 1.0) * (z / o.height + 0.5); };
  return {GripAxis::straight(Eigen::Isometry3d::Identity(), o.height, GripAxis::Section::oval,
                             {o.semi_axis_x, o.semi_axis_y}, scale)};
}

Axes axes(const TorusArc& arc, const Eigen::Matrix3d&)
{
  return {GripAxis::along(arc)};
}

Axes axes(const HalfSpace&, const Eigen::Matrix3d&)
{
  return {};
}

}  // namespace

GripAxis GripAxis::straight(const Eigen::Isometry3d& T_shape_axis, double length, Section section,
                            const Eigen::Vector2d& half_sizes, std::function<double(double)> scale,
                            const std::vector<double>& peaks)
{
  GripAxis axis;
  axis.T_shape_axis_ = T_shape_axis;
  axis.length_ = length;
  axis.section_ = section;
  axis.half_sizes_ = half_sizes;
  axis.scale_ = std::move(scale);
  for (const double z : peaks)
    axis.peaks_.push_back(z + 0.5 * length);
  return axis;
}

GripAxis GripAxis::along(const TorusArc& arc)
{
  GripAxis axis;
  axis.bend_radius_ = arc.major_radius;
  axis.length_ = 2.0 * arc.half_angle * arc.major_radius;
  axis.closed_ = arc.half_angle > kPi - 1e-9;
  axis.half_sizes_.setConstant(arc.tube_radius);
  return axis;
}

GripAxis GripAxis::along(const RoundedBox& box)
{
  GripAxis axis = straight(Eigen::Isometry3d::Identity(), box.size.z(), Section::rounded, 0.5 * box.size.head<2>());
  axis.corner_radius_ = box.corner_radius;
  return axis;
}

Eigen::Isometry3d GripAxis::sectionFrame(double place) const
{
  const double from_middle = place - 0.5 * length_;
  if (bend_radius_ == 0.0)
    return T_shape_axis_ * Eigen::Translation3d(0.0, 0.0, from_middle);
  const double angle = from_middle / bend_radius_;
  const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d tangent(-outwards.y(), outwards.x(), 0.0);
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << Eigen::Vector3d::UnitZ(), outwards, tangent;
  frame.translation() = bend_radius_ * outwards;
  return T_shape_axis_ * frame;
}

Eigen::Vector2d GripAxis::halfSizes(double place) const
{
  return scale_ ? Eigen::Vector2d(scale_(place - 0.5 * length_) * half_sizes_) : half_sizes_;
}

Eigen::Vector2d GripAxis::largestHalfSizes(double from, double to) const
{
  Eigen::Vector2d largest = halfSizes(from).cwiseMax(halfSizes(to));
  for (const double peak : peaks_) {
    if (peak > from && peak < to)
      largest = largest.cwiseMax(halfSizes(peak));
  }
  return largest;
}

double GripAxis::outlineRadius(const Eigen::Vector2d& half_sizes, const Eigen::Vector2d& direction) const
{
  if (section_ == Section::rounded)
    return roundedOutlineRadius(half_sizes, corner_radius_, direction);
  const Eigen::Vector2d ratios = direction.cwiseQuotient(half_sizes);
  const double reciprocal = section_ == Section::rectangular ? ratios.lpNorm<Eigen::Infinity>() : ratios.norm();
  return direction.norm() / reciprocal;
}

double GripAxis::largestRadius(double from, double to) const
{
  const Eigen::Vector2d half_sizes = largestHalfSizes(from, to);
  if (section_ == Section::rounded)
    return (half_sizes - Eigen::Vector2d::Constant(corner_radius_)).norm() + corner_radius_;
  return half_sizes.maxCoeff();
}

double GripAxis::nearest(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d p = T_shape_axis_.inverse() * point;
  const double from_middle = bend_radius_ == 0.0 ? p.z() : bend_radius_ * std::atan2(p.y(), p.x());
  return std::clamp(from_middle + 0.5 * length_, 0.0, length_);
}

std::vector<GripAxis> gripAxes(const Primitive& primitive, const Eigen::Matrix3d& R_scene_shape)
{
  return std::visit([&](const auto& solid) { return axes(solid, R_scene_shape); }, primitive);
}

}  // namespace grasp_affordances
