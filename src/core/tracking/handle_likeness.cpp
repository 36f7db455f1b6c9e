#include "core/tracking/handle_likeness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr double kBlobLength = 1.5;  // diameters of the shell
constexpr std::size_t kProbes = 9;
constexpr double kRadiusDifference = 0.01;  // m, from which the difference costs kRadiusWeight
constexpr double kPieceOverlap = 0.25;      // share of a part that is between the ends of the whole

// What the largest differences cost. The largest distance costs 1.
constexpr double kAngleWeight = 0.3;
constexpr double kRadiusWeight = 0.3;
constexpr double kExtentWeight = 0.3;

constexpr double squared(double x)
{
  return x * x;
}

/// How one axis runs along another.
struct Course
{
  double distance = 0.0;  ///< m, mean
  double angle = 0.0;     ///< rad, mean, without regard to the signs
  double overlap = 0.0;   ///< share of the axis between the ends of the other
};

Course course(const AxisCurve& curve, const AxisCurve& along)
{
  Course result;
  for (std::size_t i = 0; i < kProbes; ++i) {
    const double s = curve.length() * (static_cast<double>(i) + 0.5) / kProbes;
    const AxisCurve::Foot foot = along.foot(curve.at(s));
    const double cosine = std::abs(curve.direction(s).dot(along.direction(foot.s)));
    result.distance += foot.distance / kProbes;
    result.angle += std::acos(std::min(cosine, 1.0)) / kProbes;
    result.overlap += foot.s >= 0.0 && foot.s <= along.length() ? 1.0 / kProbes : 0.0;
  }
  return result;
}

/// The common extent of two curves over the extent that both cover together, along the longer curve.
double commonExtent(const AxisCurve& shorter, const AxisCurve& longer)
{
  double from = longer.foot(shorter.points().front()).s;
  double to = longer.foot(shorter.points().back()).s;
  if (from > to) {
    std::swap(from, to);
  }
  const double common = std::min(to, longer.length()) - std::max(from, 0.0);
  return std::max(common, 0.0) / (std::max(to, longer.length()) - std::min(from, 0.0));
}

}  // namespace

HandleShape::HandleShape(const GraspHandle& handle)
    : curve(handle), centroid(handle.centroid), radius(handle.radius), inner_radius(handle.inner_radius)
{
}

bool isBlob(const HandleShape& shape)
{
  return shape.curve.length() < kBlobLength * 2.0 * shape.inner_radius;
}

double unlikeness(const HandleShape& a, const HandleShape& b, const TrackingConfig& config)
{
  const bool a_is_shorter = a.curve.length() < b.curve.length();
  const AxisCurve& shorter = a_is_shorter ? a.curve : b.curve;
  const AxisCurve& longer = a_is_shorter ? b.curve : a.curve;
  Course compared = course(shorter, longer);
  if (isBlob(a) || isBlob(b)) {
    compared.distance = std::min(compared.distance, (a.centroid - b.centroid).norm());
    compared.angle = 0.0;
  }
  if (compared.distance > config.max_distance || compared.angle > config.max_angle) {
    return std::numeric_limits<double>::infinity();
  }
  const auto share = [](double value, double most) { return most > 0.0 ? std::min(value / most, 1.0) : 0.0; };
  return squared(share(compared.distance, config.max_distance)) +
         kAngleWeight * squared(share(compared.angle, config.max_angle)) +
         kRadiusWeight * squared(share(std::abs(a.radius - b.radius), kRadiusDifference)) +
         kExtentWeight * (1.0 - commonExtent(shorter, longer));
}

bool isPiece(const HandleShape& part, const HandleShape& whole, const TrackingConfig& config)
{
  const Course compared = course(part.curve, whole.curve);
  const bool any_direction = isBlob(part) || isBlob(whole);
  return compared.overlap >= kPieceOverlap && compared.distance <= whole.inner_radius &&
         (any_direction || compared.angle <= config.max_angle);
}

}  // namespace grasp_affordances
