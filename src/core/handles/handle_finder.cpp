#include "core/handles/handle_finder.h"

#include "core/cloud/depth_noise.h"
#include "core/result/axis_frame.h"
#include "core/result/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kMargin = 0.002;         // m beyond the inner radius, for noise of the surface
constexpr std::size_t kMostPoints = 300;  // of a bar's fit

/// Orders shells by their geometry, so that the order of the samples does not matter.
bool standsBefore(const Shell* a, const Shell* b)
{
  const auto key = [](const Shell& s) {
    return std::make_tuple(s.centroid.x(), s.centroid.y(), s.centroid.z(), s.axis.x(), s.axis.y(), s.axis.z(),
                           s.inner_radius, s.length);
  };
  return key(*a) < key(*b);
}

/// Standard deviation (m) of the depth at a point, as the nearest sensor measures it. Where no sensor's place is known,
/// at a usual distance.
double depthNoiseAt(const PreparedViews& views, const Eigen::Vector3d& point)
{
  constexpr double kUsualDistance = 1.0;  // m
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t view = 0; view < views.size(); ++view) {
    if (const std::optional<Eigen::Vector3d>& sensor = views[view].sensor) {
      depth = std::min(depth, (views.T_common_view(view) * *sensor - point).norm());
    }
  }
  return depthNoise(std::isfinite(depth) ? depth : kUsualDistance);
}

/// Of at least one value. Reorders the values.
double median(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void HandleFinder::find(const PreparedViews& views, const Config& config, const SampledShells& found,
                        std::vector<GraspHandle>& handles, const Cancellation& cancellation)
{
  samples_.clear();
  for (std::size_t i = 0; i < found.sample_count; ++i) {
    const auto& [view, point] = found.samples[i];
    samples_.push_back(views.T_common_view(view) * views[view].cloud->point(point).cast<double>());
  }
  groups_.update(found.shells, config.handles, cancellation);
  std::size_t count = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    cancellation.check();
    const ShellGroups::Group group = groups_[g];
    if (group.size() < static_cast<std::size_t>(config.handles.min_support)) {
      continue;
    }
    if (handles.size() == count) {
      addSpare(handles);
    }
    GraspHandle& handle = handles[count++];
    handle.shells.assign(group.begin(), group.end());
    handle.hand_poses.clear();
    handle.hits = 1;
    handle.unseen_for = 0.0;
    members_.clear();
    for (const std::uint32_t i : group) {
      members_.push_back(&found.shells[i]);
    }
    std::sort(members_.begin(), members_.end(), standsBefore);
    describe(views, config, handle);
    rate(config, handle);
    if (handle.score < config.handles.min_score) {
      --count;
    }
  }
  while (handles.size() > count) {
    spare_.push_back(std::move(handles.back()));
    handles.pop_back();
  }
  std::sort(handles.begin(), handles.end(), [](const GraspHandle& a, const GraspHandle& b) {
    const auto key = [](const GraspHandle& h) {
      return std::make_tuple(-h.score, h.centroid.x(), h.centroid.y(), h.centroid.z());
    };
    return key(a) < key(b);
  });
  for (std::size_t i = 0; i < count; ++i) {
    handles[i].id = static_cast<std::uint32_t>(i + 1);
  }
}

void HandleFinder::addSpare(std::vector<GraspHandle>& handles)
{
  if (spare_.empty()) {
    handles.emplace_back();
  } else {
    handles.push_back(std::move(spare_.back()));
    spare_.pop_back();
  }
}

void HandleFinder::describe(const PreparedViews& views, const Config& config, GraspHandle& handle)
{
  radii_.clear();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::size_t with_normal = 0;
  for (const Shell* shell : members_) {
    radii_.push_back(shell->inner_radius);
    if (isKnown(shell->normal)) {
      normal += shell->normal;
      ++with_normal;
    }
  }
  handle.inner_radius = median(radii_);
  handle.radius = handle.inner_radius;
  tracer_.trace(members_, axis_);
  if (axis_.straight()) {
    fitLine(views, handle);
  } else {
    fitBend(views, handle);
  }
  handle.polyline = axis_.polyline;
  handle.length = lengthOf(handle.polyline);
  const PolylineMiddle middle = middleOf(handle.polyline);
  handle.centroid = middle.point;
  handle.axis = withLargestComponentPositive(middle.direction);
  handle.normal =
      with_normal > 0 ? normalAcross(handle.axis, normal, 1e-6 * static_cast<double>(with_normal)) : unknownNormal();
  handle.inner_radius = std::min(std::max(handle.inner_radius, handle.radius), config.hand.capture_radius);
}

/// Gathers the points that any view measured within a sphere, in the common frame (points_).
void HandleFinder::gatherPoints(const PreparedViews& views, const Eigen::Vector3d& center, double radius)
{
  points_.clear();
  for (std::size_t view = 0; view < views.size(); ++view) {
    const Eigen::Isometry3d& T_common_view = views.T_common_view(view);
    const Eigen::Vector3d own = T_common_view.inverse() * center;
    views[view].search->withinRadius(own.cast<float>(), static_cast<float>(radius), neighborhood_);
    for (std::size_t i = 0; i < neighborhood_.size(); ++i) {
      points_.push_back(T_common_view * neighborhood_.point(i).cast<double>());
    }
  }
}

/// Selects those of the gathered points that are near a bar's axis (near_). Of more than kMostPoints it takes
/// kMostPoints at even intervals.
void HandleFinder::keepAlong(const FittedBar& bar, double half_length, double radius)
{
  near_.clear();
  for (const Eigen::Vector3d& point : points_) {
    const Eigen::Vector3d offset = point - bar.origin;
    const double along = offset.dot(bar.axis);
    if (std::abs(along) <= half_length && offset.squaredNorm() - along * along <= radius * radius) {
      near_.push_back(point);
    }
  }
  if (near_.size() > kMostPoints) {
    for (std::size_t i = 0; i < kMostPoints; ++i) {
      near_[i] = near_[i * near_.size() / kMostPoints];
    }
    near_.resize(kMostPoints);
  }
}

void HandleFinder::fitLine(const PreparedViews& views, GraspHandle& handle)
{
  const Eigen::Vector3d first = axis_.polyline.front(), last = axis_.polyline.back();
  FittedBar bar;
  bar.origin = (first + last) / 2;
  bar.axis = (last - first).normalized();
  bar.radius = handle.inner_radius;
  const double half_length = (last - first).norm() / 2;
  const double reach = handle.inner_radius + kMargin;
  gatherPoints(views, bar.origin, std::hypot(half_length, reach));
  keepAlong(bar, half_length, reach);
  BarPrior prior;
  prior.tilt = axis_.round ? 1e-3 : 0.15;
  prior.taper = axis_.round ? 1e-3 : 0.1;
  const auto fitted = fitBar(near_, bar, prior, depthNoiseAt(views, bar.origin));
  if (!fitted || fitted->radius > handle.inner_radius + kMargin) {
    return;
  }
  handle.radius = fitted->radius;
  axis_.polyline.front() = fitted->origin - half_length * fitted->axis;
  axis_.polyline.back() = fitted->origin + half_length * fitted->axis;
}

/// Fits a short bar about each point of a bent axis. The median of their radii is the handle's radius. The radius of a
/// long bar would be too large, because the surface bends away from it. Then bars of that radius are fitted, and their
/// origins are the points of the axis.
void HandleFinder::fitBend(const PreparedViews& views, GraspHandle& handle)
{
  constexpr double kHalfLength = 0.01;  // m
  const double reach = handle.inner_radius + kMargin;
  traced_ = axis_.polyline;
  BarPrior prior;
  prior.tilt = 1e-3;
  prior.taper = 1e-3;
  const auto fitPiece = [&](std::size_t i) {
    FittedBar bar;
    bar.origin = traced_[i];
    bar.axis = chordAround(traced_, i).normalized();
    bar.radius = handle.radius;
    gatherPoints(views, bar.origin, std::hypot(kHalfLength, reach));
    keepAlong(bar, kHalfLength, reach);
    const auto fitted = fitBar(near_, bar, prior, depthNoiseAt(views, bar.origin));
    return fitted && fitted->radius <= reach ? fitted : std::nullopt;
  };
  radii_.clear();
  for (std::size_t i = 0; i < traced_.size(); ++i) {
    if (const auto piece = fitPiece(i)) {
      radii_.push_back(piece->radius);
    }
  }
  if (!radii_.empty()) {
    handle.radius = median(radii_);
  }
  prior.radius = 1e-4;
  for (std::size_t i = 0; i < traced_.size(); ++i) {
    if (const auto piece = fitPiece(i)) {
      axis_.polyline[i] = piece->origin;
    }
  }
}

/// The share of the samples drawn within the handle that ended as one of its shells.
double HandleFinder::agreement(const GraspHandle& handle) const
{
  const double reach = handle.inner_radius + kMargin;
  const double farthest = handle.length / 2 + reach;
  std::size_t within = 0;
  for (const Eigen::Vector3d& sample : samples_) {
    if ((sample - handle.centroid).squaredNorm() <= farthest * farthest &&
        distanceBeside(handle.polyline, sample) <= reach) {
      ++within;
    }
  }
  return std::min(1.0, static_cast<double>(members_.size()) / static_cast<double>(std::max(within, members_.size())));
}

void HandleFinder::rate(const Config& config, GraspHandle& handle) const
{
  const auto count = static_cast<double>(members_.size());
  double in_gap = 0.0, observed = 0.0;
  for (const Shell* shell : members_) {
    const double lengths = std::max(1.0, shell->length / config.shell.clearance_length);
    in_gap += std::min(1.0, shell->points_in_gap / (lengths * config.shell.gap_points_to_block));
    observed += shell->observed_free;
  }
  handle.agreement = agreement(handle);
  handle.clearance = 1.0 - in_gap / count;
  handle.observed_free = observed / count;
  constexpr double kHalfSupport = 5.0;  // shells
  const double support = count / (count + kHalfSupport);
  const double length = std::min(1.0, handle.length / (2.0 * config.shell.clearance_length));
  constexpr double kFullAgreement = 0.3;
  double product = support * handle.clearance * length * std::sqrt(std::min(1.0, handle.agreement / kFullAgreement));
  double factors = 4.0;
  if (std::isfinite(handle.observed_free)) {
    product *= std::min(1.0, 2.0 * handle.observed_free);
    factors += 1.0;
  }
  handle.score = std::pow(product, 1.0 / factors);
}

}  // namespace grasp_affordances
