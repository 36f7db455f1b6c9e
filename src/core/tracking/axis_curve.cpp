#include "core/tracking/axis_curve.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kShortestPiece = 1e-6;  // m; points that are nearer to each other are one

/// The points of a handle's polyline, where no point is the same as the one before.
Polyline distinctPoints(const GraspHandle& handle)
{
  Polyline points;
  for (const Eigen::Vector3d& point : handle.polyline) {
    if (points.empty() || (point - points.back()).norm() > kShortestPiece) {
      points.push_back(point);
    }
  }
  if (points.size() < 2) {
    const Eigen::Vector3d half = std::max(handle.length, 2.0 * kShortestPiece) / 2.0 * handle.axis;
    points = {handle.centroid - half, handle.centroid + half};
  }
  return points;
}

}  // namespace

AxisCurve::AxisCurve(const GraspHandle& handle) : points_(distinctPoints(handle))
{
  measure();
}

AxisCurve::AxisCurve(Polyline points) : points_(std::move(points))
{
  measure();
}

void AxisCurve::measure()
{
  ways_.assign(1, 0.0);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    ways_.push_back(ways_.back() + (points_[i] - points_[i - 1]).norm());
  }
}

std::size_t AxisCurve::pieceAt(double s) const
{
  const auto next = std::upper_bound(ways_.begin() + 1, ways_.end() - 1, s);
  return static_cast<std::size_t>(next - ways_.begin()) - 1;
}

Eigen::Vector3d AxisCurve::at(double s) const
{
  const std::size_t piece = pieceAt(s);
  return points_[piece] + (s - ways_[piece]) * direction(s);
}

Eigen::Vector3d AxisCurve::direction(double s) const
{
  const std::size_t piece = pieceAt(s);
  return (points_[piece + 1] - points_[piece]).normalized();
}

AxisCurve::Foot AxisCurve::foot(const Eigen::Vector3d& point) const
{
  Foot foot{0.0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const Eigen::Vector3d piece = points_[i + 1] - points_[i];
    const double length = piece.norm();
    const double along = (point - points_[i]).dot(piece) / length;
    const double within = std::clamp(along, 0.0, length);
    const double distance = (points_[i] + within / length * piece - point).norm();
    if (distance < foot.distance) {
      const bool beyond = (i == 0 && along < 0.0) || (i + 2 == points_.size() && along > length);
      foot = {ways_[i] + (beyond ? along : within), distance};
    }
  }
  return foot;
}

Polyline AxisCurve::spread(double from, double to, std::size_t count) const
{
  Polyline result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(at(from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1)));
  }
  return result;
}

AxisCurve straightCurve(const Polyline& points)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    mean += point / static_cast<double>(points.size());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    scatter += (point - mean) * (point - mean).transpose();
  }
  const Eigen::Vector3d direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2);
  const auto projected = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return mean + (point - mean).dot(direction) * direction;
  };
  return AxisCurve({projected(points.front()), projected(points.back())});
}

}  // namespace grasp_affordances
