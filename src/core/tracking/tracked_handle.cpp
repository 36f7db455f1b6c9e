#include "core/tracking/tracked_handle.h"

#include "core/result/axis_frame.h"
#include "grasp_affordances/localization.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kCurvePoints = 17;
// The weight of an end that is found short of where it is known to be. It is low: something that hides a part of a
// handle, or samples that miss it, make a handle too short, and nothing makes it too long as often.
constexpr double kShortfallWeight = 0.25;
constexpr double kAxisSupport = 0.5;  // share of the length over which the axis of a bent handle is taken

/// The places along a curve (m) between which another curve runs, the smaller one first.
struct Extent
{
  double from, to;
};

Extent extentOn(const AxisCurve& curve, const AxisCurve& other)
{
  const double a = curve.foot(other.points().front()).s;
  const double b = curve.foot(other.points().back()).s;
  return {std::min(a, b), std::max(a, b)};
}

void approach(double& value, double found, double weight)
{
  value = std::isnan(value) || std::isnan(found) ? found : value + weight * (found - value);
}

/// Displacements (m) from points of one curve to another curve. A point beyond an end of the other curve has the
/// displacement of that end.
class Displacements
{
public:
  Displacements(const AxisCurve& from, const AxisCurve& to)
      : to_(to),
        at_front_(to.points().front() - from.at(from.foot(to.points().front()).s)),
        at_back_(to.points().back() - from.at(from.foot(to.points().back()).s))
  {
  }

  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const
  {
    const double s = to_.foot(point).s;
    if (s < 0.0) {
      return at_front_;
    }
    if (s > to_.length()) {
      return at_back_;
    }
    return to_.at(s) - point;
  }

private:
  const AxisCurve& to_;
  Eigen::Vector3d at_front_, at_back_;
};

/// A pose, moved from one curve to another together with the place of the first curve that is nearest to it.
/// @param turn  whether it turns with the direction of the curve; not for a blob, whose axis may have any direction
Eigen::Isometry3d carriedOver(const Eigen::Isometry3d& pose, const AxisCurve& from, const AxisCurve& to, bool turn)
{
  const double s = std::clamp(from.foot(pose.translation()).s, 0.0, from.length());
  const Eigen::Vector3d origin = from.at(s);
  const double s_to = to.foot(origin).s;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  if (turn) {
    const Eigen::Vector3d direction = from.direction(s);
    const Eigen::Vector3d direction_to = to.direction(s_to);
    rotation.setFromTwoVectors(direction, direction.dot(direction_to) < 0.0 ? -direction_to : direction_to);
  }
  return Eigen::Translation3d(to.at(s_to)) * rotation * Eigen::Translation3d(-origin) * pose;
}

}  // namespace

TrackedHandle::TrackedHandle(const GraspHandle& found, double stamp)
    : handle_(found),
      known_(found),
      last_(found),
      axis_scatter_(found.axis * found.axis.transpose()),
      bent_share_(last_.curve.straight() ? 0.0 : 1.0),
      last_seen_(stamp)
{
  handle_.hits = 1;
  handle_.unseen_for = 0.0;
}

void TrackedHandle::update(const GraspHandle& found, const std::vector<const GraspHandle*>& pieces, double stamp,
                           double smoothing_time)
{
  ++handle_.hits;
  const double elapsed = stamp - last_seen_;
  const double weight = smoothing_time > 0.0 ? std::max(1.0 - std::exp(-elapsed / smoothing_time),
                                                        1.0 / static_cast<double>(handle_.hits))
                                             : 1.0;
  last_ = HandleShape(found);
  average(found, pieces, weight);
  known_ = HandleShape(handle_);
  last_seen_ = stamp;
  handle_.unseen_for = 0.0;
}

void TrackedHandle::miss(double stamp)
{
  handle_.unseen_for = stamp - last_seen_;
  handle_.shells.clear();
}

void TrackedHandle::average(const GraspHandle& found, const std::vector<const GraspHandle*>& pieces, double weight)
{
  handle_.shells = found.shells;
  for (const GraspHandle* piece : pieces) {
    handle_.shells.insert(handle_.shells.end(), piece->shells.begin(), piece->shells.end());
  }
  std::sort(handle_.shells.begin(), handle_.shells.end());
  approach(handle_.radius, found.radius, weight);
  approach(handle_.inner_radius, found.inner_radius, weight);
  approach(handle_.score, found.score, weight);
  approach(handle_.agreement, found.agreement, weight);
  approach(handle_.clearance, found.clearance, weight);
  approach(handle_.observed_free, found.observed_free, weight);
  approach(bent_share_, last_.curve.straight() ? 0.0 : 1.0, weight);

  const bool blob = isBlob(known_);
  setCurve(blob ? averagedBlob(found, weight) : averagedCurve(last_.curve, pieces, weight));
  if (!blob) {
    axis_scatter_ = handle_.axis * handle_.axis.transpose();
  }
  if (isKnown(handle_.normal) && isKnown(found.normal)) {
    const Eigen::Vector3d normal = handle_.normal + weight * (found.normal - handle_.normal);
    handle_.normal = normalAcross(handle_.axis, normal, 1e-6);
  } else {  // as approach()
    handle_.normal = isKnown(found.normal) ? normalAcross(handle_.axis, found.normal, 1e-6) : unknownNormal();
  }

  handle_.hand_poses = found.hand_poses;
  const AxisCurve curve(handle_);
  for (GraspPose& hand : handle_.hand_poses) {
    hand.pose = carriedOver(hand.pose, last_.curve, curve, !blob);
  }
}

/// Every point of the known curve moves a part of the way, `weight`, to the curve that was found. So do its ends along
/// the curve.
AxisCurve TrackedHandle::averagedCurve(const AxisCurve& found, const std::vector<const GraspHandle*>& pieces,
                                       double weight) const
{
  const AxisCurve& curve = known_.curve;
  Extent extent = extentOn(curve, found);
  for (const GraspHandle* piece : pieces) {
    const Extent more = extentOn(curve, AxisCurve(*piece));
    extent = {std::min(extent.from, more.from), std::max(extent.to, more.to)};
  }
  if (weight == 1.0 && pieces.empty()) {
    return found;
  }
  const auto gone = [weight](double beyond) { return weight * (beyond < 0.0 ? kShortfallWeight : 1.0) * beyond; };
  std::vector<Eigen::Vector3d> points =
      curve.spread(-gone(-extent.from), curve.length() + gone(extent.to - curve.length()), kCurvePoints);
  const Displacements displacements(curve, found);
  for (Eigen::Vector3d& point : points) {
    point += weight * displacements(point);
  }
  return bent_share_ > 0.5 ? AxisCurve(std::move(points)) : straightCurve(points);
}

AxisCurve TrackedHandle::averagedBlob(const GraspHandle& found, double weight)
{
  axis_scatter_ += weight * (found.axis * found.axis.transpose() - axis_scatter_);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(axis_scatter_);
  Eigen::Vector3d axis = solver.eigenvectors().col(2);
  if (axis.dot(known_.curve.direction(0.0)) < 0.0) {
    axis = -axis;
  }
  const Eigen::Vector3d centroid = known_.centroid + weight * (found.centroid - known_.centroid);
  const double length = known_.curve.length() + weight * (last_.curve.length() - known_.curve.length());
  return AxisCurve({centroid - length / 2.0 * axis, centroid + length / 2.0 * axis});
}

void TrackedHandle::setCurve(const AxisCurve& curve)
{
  const double middle = curve.length() / 2.0;
  const double support = kAxisSupport / 2.0 * curve.length();
  handle_.polyline = curve.points();
  handle_.length = curve.length();
  handle_.centroid = curve.at(middle);
  handle_.axis = withLargestComponentPositive((curve.at(middle + support) - curve.at(middle - support)).normalized());
}

}  // namespace grasp_affordances
