#include "grasp_affordances/shell.h"

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

ShellSearchResult ShellSearch::search(const NeighborhoodSearch& cloud, const FittedCylinder& cylinder,
                                      const HandGeometry& hand, const ShellConfig& config, double spacing)
{
  ShellSearchResult result;
  if (!(cylinder.radius <= hand.capture_radius)) {
    return result;
  }
  slices_ = makeSlices(config, spacing);
  steps_ = static_cast<std::size_t>((hand.capture_radius - cylinder.radius) / config.radius_step) + 1;
  gatherPoints(cloud, cylinder, hand.capture_radius + hand.finger_thickness);
  countPoints(cylinder, hand, config);

  const PointThresholds thresholds = pointThresholds(config, spacing);
  const double points_to_block_slice =
      std::max(2.0, 2.0 * thresholds.gap_points_to_block * slices_.thickness / config.clearance_length);
  const auto clear_and_occupied = [&](const Extent& extent) {
    const double lengths = std::max(1.0, extent.length() / config.clearance_length);
    return extent.inside >= lengths * thresholds.min_points_inside &&
           extent.in_gap < lengths * thresholds.gap_points_to_block;
  };
  for (std::size_t j = 0; j < steps_; ++j) {
    Extent extent = config.measure_length ? measuredExtent(j, points_to_block_slice) : wholeExtent(j);
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

void ShellSearch::gatherPoints(const NeighborhoodSearch& cloud, const FittedCylinder& cylinder, double outer_radius)
{
  const double half_length = -slices_.begin;
  const double sphere = std::hypot(outer_radius, half_length);
  cloud.withinRadius(cylinder.origin.cast<float>(), static_cast<float>(1.0001 * sphere), surroundings_);
  points_.clear();
  for (std::size_t i = 0; i < surroundings_.size(); ++i) {
    const Eigen::Vector3d p = surroundings_.point(i).cast<double>() - cylinder.origin;
    const double along = p.dot(cylinder.axis);
    const double radial = (p - along * cylinder.axis).norm();
    if (std::abs(along) <= half_length && radial <= outer_radius) {
      points_.push_back({along, radial});
    }
  }
}

void ShellSearch::countPoints(const FittedCylinder& cylinder, const HandGeometry& hand, const ShellConfig& config)
{
  const double radius = cylinder.radius;
  const double step = config.radius_step;
  for (auto* counts : {&fill_counts_, &inner_counts_, &outer_counts_}) {
    counts->assign(steps_ * slices_.count, 0);
  }
  const auto count = [&](std::vector<std::uint32_t>& counts, std::size_t first_step, std::size_t slice) {
    if (first_step < steps_) {
      ++counts[first_step * slices_.count + slice];
    }
  };
  for (const AxisPoint& point : points_) {
    const auto slice =
        std::min(static_cast<std::size_t>((point.along - slices_.begin) / slices_.thickness), slices_.count - 1);
    count(fill_counts_, firstStepReaching(point.radial, config.min_fill * radius, config.min_fill * step, steps_),
          slice);
    count(inner_counts_, firstStepReaching(point.radial, radius, step, steps_), slice);
    count(outer_counts_, firstStepReaching(point.radial, radius + hand.finger_thickness, step, steps_), slice);
  }
  for (auto* counts : {&fill_counts_, &inner_counts_, &outer_counts_}) {
    for (std::size_t i = slices_.count; i < counts->size(); ++i) {
      (*counts)[i] += (*counts)[i - slices_.count];
    }
  }
}

ShellSearch::Extent ShellSearch::wholeExtent(std::size_t step) const
{
  Extent extent{slices_.begin, -slices_.begin, 0, 0};
  for (std::size_t slice = 0; slice < slices_.count; ++slice) {
    const std::size_t i = step * slices_.count + slice;
    extent.inside += inner_counts_[i];
    extent.in_gap += outer_counts_[i] - inner_counts_[i];
  }
  return extent;
}

/// The slices around the sample's that follow one another occupied inside and clear around.
ShellSearch::Extent ShellSearch::measuredExtent(std::size_t step, double points_to_block_slice) const
{
  const std::uint32_t* fill = &fill_counts_[step * slices_.count];
  const std::uint32_t* inner = &inner_counts_[step * slices_.count];
  const std::uint32_t* outer = &outer_counts_[step * slices_.count];
  const auto graspable = [&](std::size_t slice) {
    return inner[slice] > fill[slice] && outer[slice] - inner[slice] < points_to_block_slice;
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
  Extent extent;
  extent.begin = slices_.begin + static_cast<double>(first) * slices_.thickness;
  extent.end = slices_.begin + static_cast<double>(last + 1) * slices_.thickness;
  for (std::size_t slice = first; slice <= last; ++slice) {
    extent.inside += inner[slice];
    extent.in_gap += outer[slice] - inner[slice];
  }
  return extent;
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
  for (const AxisPoint& point : points_) {
    if (point.along >= refined.begin && point.along <= refined.end) {
      refined.inside += point.radial <= inner_radius ? 1 : 0;
      refined.in_gap += point.radial > inner_radius && point.radial <= outer_radius ? 1 : 0;
    }
  }
  return refined;
}

}  // namespace grasp_affordances
