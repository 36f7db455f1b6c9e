#pragma once

#include "core/neighborhoods/neighborhoods.h"
#include "core/parallel/random.h"
#include "grasp_affordances/cloud.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances::test
{

using Points = std::vector<Eigen::Vector3d>;

/// Reproducible draws, the same on every platform.
class Random
{
public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}

  double uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(randomBits(seed_, counter_++) >> 11U) * 0x1p-53;
  }

  /// Standard normal (Box and Muller).
  double normal()
  {
    const double radius = std::sqrt(-2.0 * std::log(uniform(1e-300, 1.0)));
    return radius * std::cos(uniform(0.0, 2.0 * M_PI));
  }

  Eigen::Vector3d direction() { return Eigen::Vector3d(normal(), normal(), normal()).normalized(); }

  Eigen::Matrix3d rotation()
  {
    return Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized().toRotationMatrix();
  }

private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

/// Points that a sensor at the origin saw.
inline Cloud cloudOf(const Points& points)
{
  Cloud cloud;
  cloud.sensor_origin = Eigen::Vector3f::Zero();
  cloud.reset(static_cast<std::uint32_t>(points.size()), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = points[i].cast<float>();
    cloud.set(i, p.x(), p.y(), p.z());
  }
  return cloud;
}

/// A cloud without its rows, and without the intrinsics of the camera: no range image. Points keep their indices. The
/// place of the sensor is known: that of a range image is the origin.
inline Cloud unorganized(Cloud cloud)
{
  cloud.sensor_origin = cloud.sensor_origin.value_or(Eigen::Vector3f::Zero());
  cloud.width = static_cast<std::uint32_t>(cloud.size());
  cloud.height = 1;
  cloud.intrinsics.reset();
  return cloud;
}

inline std::size_t measuredPoints(const Cloud& cloud)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    count += cloud.measured(i) ? 1 : 0;
  }
  return count;
}

/// All points of a cloud within a sphere, found by looking at each point.
inline Neighborhood bruteForceNeighborhood(const Cloud& cloud, const Eigen::Vector3f& center, float radius)
{
  Neighborhood neighborhood;
  neighborhood.clear(center, radius);
  neighborhood.appendRange(cloud, 0, cloud.size());
  return neighborhood;
}

inline Neighborhood neighborhoodOf(const Points& points, const Eigen::Vector3d& center, double radius)
{
  return bruteForceNeighborhood(cloudOf(points), center.cast<float>(), static_cast<float>(radius));
}

/// Angle between two lines (rad), in [0, pi/2].
inline double lineAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// Points on a cylinder about the z axis: an arc of `arc` rad centred on the direction (0, -1, 0), of a given length.
inline Points cylinderPoints(double radius, double arc, double length, std::size_t count, Random& random,
                             double noise = 0.0)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(-arc / 2, arc / 2);
    const double r = radius + noise * random.normal();
    points.emplace_back(r * std::sin(angle), -r * std::cos(angle), random.uniform(-length / 2, length / 2));
  }
  return points;
}

/// A cloud in another frame, with the place of its sensor. Where that is not given, it is the origin.
inline Cloud moved(const Cloud& cloud, const Eigen::Isometry3d& T)
{
  Cloud result = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = (T * cloud.point(i).cast<double>()).cast<float>();
    result.set(i, p.x(), p.y(), p.z());
  }
  const Eigen::Vector3f sensor = cloud.sensor_origin.value_or(Eigen::Vector3f::Zero());
  result.sensor_origin = (T * sensor.cast<double>()).cast<float>();
  return result;
}

inline Points transformed(Points points, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
{
  for (Eigen::Vector3d& p : points) {
    p = rotation * p + translation;
  }
  return points;
}

}  // namespace grasp_affordances::test
