#pragma once

#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"

#include "core/tracking/axis_curve.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{

using Eigen::Vector3d;
using Handles = std::vector<GraspHandle>;

constexpr double kPeriod = 0.1;  // s
constexpr double kDegree = 3.14159265358979323846 / 180.0;

inline GraspHandle bent(std::vector<Vector3d> polyline, double radius = 0.01)
{
  GraspHandle handle;
  handle.polyline = std::move(polyline);
  const AxisCurve curve(handle.polyline);
  handle.length = curve.length();
  handle.centroid = curve.at(curve.length() / 2.0);
  handle.axis = withLargestComponentPositive(curve.direction(curve.length() / 2.0));
  handle.normal = handle.axis.unitOrthogonal();
  handle.radius = radius;
  handle.inner_radius = radius + 0.002;
  handle.score = 0.5;
  handle.observed_free = 0.8;
  handle.shells = {0, 1, 2};
  GraspPose hand;
  hand.pose.linear() << -handle.normal, handle.axis.cross(-handle.normal), handle.axis;
  hand.pose.translation() = handle.centroid;
  handle.hand_poses = {hand};
  return handle;
}

inline GraspHandle straight(const Vector3d& centroid, const Vector3d& axis, double length = 0.1, double radius = 0.01)
{
  const Vector3d half = length / 2.0 * axis.normalized();
  return bent({centroid - half, centroid + half}, radius);
}

inline Vector3d onArc(double radius, double angle)
{
  return {radius * std::cos(angle), radius * std::sin(angle), 0.8};
}

/// A part of a circle about (0, 0, 0.8).
inline GraspHandle arc(double radius, double from, double to)
{
  std::vector<Vector3d> points;
  for (int i = 0; i <= 12; ++i) {
    points.push_back(onArc(radius, from + (to - from) * i / 12.0));
  }
  return bent(points);
}

class Noise
{
public:
  explicit Noise(std::uint32_t seed) : generator_(seed) {}
  double operator()(double deviation) { return std::normal_distribution<double>(0.0, deviation)(generator_); }
  Vector3d vector(double deviation)
  {
    const double x = (*this)(deviation), y = (*this)(deviation), z = (*this)(deviation);
    return {x, y, z};
  }
  bool chance(double share) { return std::uniform_real_distribution<double>()(generator_) < share; }

private:
  std::mt19937 generator_;  // its numbers, unlike those of the distributions, are the same everywhere
};

/// Ends moved on their own; the polyline begins at either end.
inline GraspHandle noisy(const GraspHandle& handle, Noise& noise, double deviation)
{
  GraspHandle result =
      bent({handle.polyline.front() + noise.vector(deviation), handle.polyline.back() + noise.vector(deviation)},
           handle.radius + noise(0.001));
  if (noise.chance(0.5)) {
    std::reverse(result.polyline.begin(), result.polyline.end());
  }
  return result;
}

inline std::vector<std::uint32_t> ids(const Handles& handles)
{
  std::vector<std::uint32_t> result;
  for (const GraspHandle& handle : handles) {
    result.push_back(handle.id);
  }
  return result;
}

using Ids = std::vector<std::uint32_t>;

inline double angleBetween(const Vector3d& a, const Vector3d& b)
{
  return std::acos(std::min(1.0, std::abs(a.dot(b)) / (a.norm() * b.norm())));
}

inline const GraspHandle kBar = straight({0.0, 0.0, 0.8}, {1.0, 0.2, 0.0});
inline const GraspHandle kPole = straight({0.2, 0.1, 0.9}, {0.0, 0.0, 1.0}, 0.12, 0.015);

}  // namespace grasp_affordances::test
