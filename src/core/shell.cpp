#include "grasp_affordances/shell.h"

#include "grasp_affordances/circle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

/// Radius of the shell after a number of steps: one expression, so that all counts agree on borderline points.
double steppedRadius(double first, double step, std::size_t steps)
{
  return first + step * static_cast<double>(steps);
}

/// The first step at which the radius reaches a distance from the axis; `steps` where none does.
std::size_t firstStepReaching(double distance, double first, double step, std::size_t steps)
{
  if (distance <= first) {
    return 0;
  }
  if (step == 0.0) {
    return steps;
  }
  const double guess = std::ceil((distance - first) / step);
  std::size_t j = guess < static_cast<double>(steps) ? static_cast<std::size_t>(guess) : steps;
  while (j > 0 && distance <= steppedRadius(first, step, j - 1)) {
    --j;
  }
  while (j < steps && distance > steppedRadius(first, step, j)) {
    ++j;
  }
  return j;
}

}  // namespace

PointThresholds pointThresholds(const ShellConfig& config, double spacing)
{
  PointThresholds thresholds{static_cast<double>(config.gap_points_to_block),
                             static_cast<double>(config.min_points_inside)};
  if (config.scale_with_density && spacing > 0.0) {
    const double ratio = config.reference_spacing / spacing;
    constexpr double kFewest = 2.0;  // a single point is never evidence
    thresholds.gap_points_to_block = std::max(kFewest, thresholds.gap_points_to_block * ratio * ratio);
    thresholds.min_points_inside = std::max(kFewest, thresholds.min_points_inside * ratio * ratio);
  }
  return thresholds;
}

ShellSearchResult ShellSearch::search(const ShellSurroundings& surroundings, const FittedCylinder& cylinder,
                                      const HandGeometry& hand, const ShellConfig& config)
{
  const ShellSearchResult found = searchAbout(surroundings, cylinder, hand, config);
  if (!config.recenter || found.status != ShellSearchResult::found) {
    return found;
  }
  const auto refitted = refit(cylinder, found, hand, config.radius_step);
  return refitted ? searchAbout(surroundings, *refitted, hand, config) : found;
}

ShellSearchResult ShellSearch::searchAbout(const ShellSurroundings& surroundings, const FittedCylinder& cylinder,
                                           const HandGeometry& hand, const ShellConfig& config)
{
  ShellSearchResult result;
  if (!(cylinder.radius <= hand.capture_radius)) {
    return result;
  }
  const double spacing = surroundings.spacing;
  const double depth_error =
      surroundings.image != nullptr ? config.depth_error * cylinder.origin.z() * cylinder.origin.z() : 0.0;
  slices_ = makeSlices(config, spacing);
  steps_ = static_cast<std::size_t>((hand.capture_radius - cylinder.radius) / config.radius_step) + 1;
  const Axis axis(cylinder);
  const double outermost = hand.capture_radius + hand.finger_thickness;
  gatherPoints(surroundings.cloud, axis, outermost, points_);
  hidden_points_.clear();
  if (surroundings.hidden != nullptr) {
    gatherPoints(*surroundings.hidden, axis, outermost, hidden_points_);
  }
  countPoints(cylinder.radius, depth_error, hand, config);
  findUnseenSlices(surroundings.image, axis, cylinder.radius, hand);

  const PointThresholds thresholds = pointThresholds(config, spacing);
  const double points_to_block_slice =
      std::max(2.0, 2.0 * thresholds.gap_points_to_block * slices_.thickness / config.clearance_length);
  const auto clear_and_occupied = [&](const Extent& extent) {
    const double lengths = std::max(1.0, extent.length() / config.clearance_length);
    return extent.inside >= lengths * thresholds.min_points_inside &&
           extent.in_gap + extent.hidden_in_gap < lengths * thresholds.gap_points_to_block;
  };
  for (std::size_t j = 0; j < steps_; ++j) {
    Extent extent =
        config.measure_length ? measuredExtent(j, points_to_block_slice) : extentOf(j, 0, slices_.count - 1);
    if (!clear_and_occupied(extent)) {
      continue;
    }
    const double radius = steppedRadius(cylinder.radius, config.radius_step, j);
    if (config.measure_length) {
      extent =
          refinedExtent(extent, radius, radius + hand.finger_thickness, std::max(spacing / 2, 1e-6), config.max_length);
      if (extent.length() < config.min_length || !clear_and_occupied(extent)) {
        result.status = ShellSearchResult::too_short;
        continue;
      }
    }
    result.status = ShellSearchResult::found;
    result.centroid = cylinder.origin + (extent.begin + extent.end) / 2 * cylinder.axis;
    result.inner_radius = radius;
    result.length = extent.length();
    result.points_inside = extent.inside;
    result.points_in_gap = extent.in_gap;
    return result;
  }
  return result;
}

/// The cylinder about the same direction through the points inside a shell, which was just found. The radius is the
/// surface's, up to the next whole number of steps below the capture radius: so the last shell that is tried is the
/// largest that the hand can enclose.
std::optional<FittedCylinder> ShellSearch::refit(const FittedCylinder& cylinder, const ShellSearchResult& found,
                                                 const HandGeometry& hand, double radius_step)
{
  const double middle = (found.centroid - cylinder.origin).dot(cylinder.axis);
  inside_.clear();
  for (const AxisPoint& point : points_) {
    if (std::abs(point.along - middle) <= found.length / 2 && point.radial <= found.inner_radius) {
      inside_.push_back(point.across);
    }
  }
  const auto circle = fitCircleTaubin(inside_);
  if (!circle) {
    return std::nullopt;
  }
  const Axis axis(cylinder);
  FittedCylinder refitted = cylinder;
  refitted.origin += circle->center.x() * axis.first + circle->center.y() * axis.second;
  const double room = hand.capture_radius - circle->radius;
  constexpr double kRounding = 1.0 + 1e-12;  // or the search, counting the steps back, might lose the last one
  refitted.radius =
      room >= 0.0 ? hand.capture_radius - std::floor(room / radius_step) * radius_step * kRounding : circle->radius;
  return refitted;
}

// Without a measured length there is one slice, the clearance length. Otherwise their number is odd: the sample is in
// the middle of the middle one.
ShellSearch::Slices ShellSearch::makeSlices(const ShellConfig& config, double spacing)
{
  Slices slices;
  slices.thickness = config.clearance_length;
  if (config.measure_length) {
    constexpr double kPointsPerSlice = 1.5;  // thinner slices would look empty between two rows of points
    slices.thickness = std::max(config.length_resolution, kPointsPerSlice * spacing);
    slices.count = 2 * static_cast<std::size_t>(config.max_length / 2 / slices.thickness) + 1;
  }
  slices.begin = -slices.thickness * static_cast<double>(slices.count) / 2;
  return slices;
}

ShellSearch::Axis::Axis(const FittedCylinder& cylinder)
    : origin(cylinder.origin),
      direction(cylinder.axis),
      first(direction.unitOrthogonal()),
      second(direction.cross(first))
{
}

void ShellSearch::gatherPoints(const NeighborhoodSearch& cloud, const Axis& axis, double outer_radius,
                               std::vector<AxisPoint>& points)
{
  const double half_length = -slices_.begin;
  const double sphere = std::hypot(outer_radius, half_length);
  cloud.withinRadius(axis.origin.cast<float>(), static_cast<float>(1.0001 * sphere), sphere_);
  points.clear();
  for (std::size_t i = 0; i < sphere_.size(); ++i) {
    const Eigen::Vector3d p = sphere_.point(i).cast<double>() - axis.origin;
    const double along = p.dot(axis.direction);
    const Eigen::Vector2d across(p.dot(axis.first), p.dot(axis.second));
    const double radial = across.norm();
    if (std::abs(along) <= half_length && radial <= outer_radius) {
      points.push_back({across, along, radial});
    }
  }
}

std::size_t ShellSearch::sliceOf(const AxisPoint& point) const
{
  return std::min(static_cast<std::size_t>((point.along - slices_.begin) / slices_.thickness), slices_.count - 1);
}

void ShellSearch::countPoints(double first_radius, double depth_error, const HandGeometry& hand,
                              const ShellConfig& config)
{
  const double step = config.radius_step;
  const double first_outer = first_radius + hand.finger_thickness;
  for (Counts* counts : {&fill_, &inner_, &outer_, &hidden_inner_, &hidden_outer_}) {
    counts->reset(steps_, slices_.count);
  }
  for (const AxisPoint& point : points_) {
    const std::size_t slice = sliceOf(point);
    inner_.add(point.radial, slice, first_radius, step);
    outer_.add(point.radial, slice, first_outer, step);
    if (config.min_fill > 0.0) {
      // Larger shells than this are no longer filled by the point.
      const double filled = std::max(point.radial / config.min_fill, point.radial + depth_error);
      fill_.add(filled, slice, first_radius, step);
    }
  }
  for (const AxisPoint& point : hidden_points_) {
    const std::size_t slice = sliceOf(point);
    hidden_inner_.add(point.radial, slice, first_radius, step);
    hidden_outer_.add(point.radial, slice, first_outer, step);
  }
  for (Counts* counts : {&fill_, &inner_, &outer_, &hidden_inner_, &hidden_outer_}) {
    counts->accumulate();
  }
}

/// The slices of which the sensor could see nothing: in front of the axis something nearer than the hand reaches was
/// measured, or nothing.
void ShellSearch::findUnseenSlices(const RangeImage* image, const Axis& axis, double radius, const HandGeometry& hand)
{
  unseen_.assign(slices_.count, false);
  if (image == nullptr) {
    return;
  }
  const Eigen::Vector3d across = 0.5 * radius * axis.direction.cross(axis.origin).normalized();
  const auto seen = [&](const Eigen::Vector3d& point) {
    const auto pixel = image->pixel(point);
    return pixel && image->cloud().measured(*pixel) &&
           image->cloud().point(*pixel).cast<double>().norm() > point.norm() - hand.capture_radius;
  };
  for (std::size_t slice = 0; slice < slices_.count; ++slice) {
    const double along = slices_.begin + (static_cast<double>(slice) + 0.5) * slices_.thickness;
    const Eigen::Vector3d middle = axis.origin + along * axis.direction;
    unseen_[slice] = !seen(middle - across) && !seen(middle) && !seen(middle + across);
  }
}

void ShellSearch::Counts::reset(std::size_t steps, std::size_t slices)
{
  steps_ = steps;
  slices_ = slices;
  counts_.assign(steps * slices, 0);
}

void ShellSearch::Counts::add(double radius, std::size_t slice, double first_radius, double radius_step)
{
  const std::size_t step = firstStepReaching(radius, first_radius, radius_step, steps_);
  if (step < steps_) {
    ++counts_[step * slices_ + slice];
  }
}

void ShellSearch::Counts::accumulate()
{
  for (std::size_t i = slices_; i < counts_.size(); ++i) {
    counts_[i] += counts_[i - slices_];
  }
}

std::uint32_t ShellSearch::gapPoints(std::size_t step, std::size_t slice) const
{
  return outer_(step, slice) - inner_(step, slice);
}

std::uint32_t ShellSearch::hiddenGapPoints(std::size_t step, std::size_t slice) const
{
  return hidden_outer_(step, slice) - hidden_inner_(step, slice);
}

ShellSearch::Extent ShellSearch::extentOf(std::size_t step, std::size_t first_slice, std::size_t last_slice) const
{
  Extent extent;
  extent.begin = slices_.begin + static_cast<double>(first_slice) * slices_.thickness;
  extent.end = slices_.begin + static_cast<double>(last_slice + 1) * slices_.thickness;
  for (std::size_t slice = first_slice; slice <= last_slice; ++slice) {
    extent.inside += inner_(step, slice);
    extent.in_gap += gapPoints(step, slice);
    extent.hidden_in_gap += hiddenGapPoints(step, slice);
  }
  return extent;
}

/// The slices around the sample's that follow one another occupied inside and clear around.
ShellSearch::Extent ShellSearch::measuredExtent(std::size_t step, double points_to_block_slice) const
{
  const auto occupied = [&](std::size_t slice) {
    const std::uint32_t inside = inner_(step, slice);
    return inside > fill_(step, slice) || (inside == 0 && unseen_[slice]);
  };
  const auto graspable = [&](std::size_t slice) {
    return occupied(slice) && gapPoints(step, slice) + hiddenGapPoints(step, slice) < points_to_block_slice;
  };
  const std::size_t middle = slices_.count / 2;
  if (!graspable(middle)) {
    return Extent();
  }
  std::size_t first = middle, last = middle;
  while (first > 0 && graspable(first - 1)) {
    --first;
  }
  while (last + 1 < slices_.count && graspable(last + 1)) {
    ++last;
  }
  return extentOf(step, first, last);
}

/// From whole slices to the outermost points inside, each of which stands for a surface that goes on by `margin`, but
/// not into slices that are not clear, and not beyond the length that is measured.
ShellSearch::Extent ShellSearch::refinedExtent(const Extent& extent, double inner_radius, double outer_radius,
                                               double margin, double max_length) const
{
  Extent refined;
  refined.begin = std::numeric_limits<double>::infinity();
  refined.end = -refined.begin;
  for (const AxisPoint& point : points_) {
    if (point.radial <= inner_radius && point.along >= extent.begin && point.along <= extent.end) {
      refined.begin = std::min(refined.begin, point.along - margin);
      refined.end = std::max(refined.end, point.along + margin);
    }
  }
  refined.begin = std::max({refined.begin, extent.begin, -max_length / 2});
  refined.end = std::min({refined.end, extent.end, max_length / 2});
  const auto within = [&](const AxisPoint& point) {
    return point.along >= refined.begin && point.along <= refined.end;
  };
  const auto in_gap = [&](const AxisPoint& point) {
    return within(point) && point.radial > inner_radius && point.radial <= outer_radius;
  };
  for (const AxisPoint& point : points_) {
    refined.inside += within(point) && point.radial <= inner_radius ? 1 : 0;
    refined.in_gap += in_gap(point) ? 1 : 0;
  }
  for (const AxisPoint& point : hidden_points_) {
    refined.hidden_in_gap += in_gap(point) ? 1 : 0;
  }
  return refined;
}

}  // namespace grasp_affordances
