#include "core/shell/directed_search.h"

#include "core/fit/circle.h"
#include "core/result/axis_frame.h"
#include "core/shell/evidence.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace grasp_affordances
{
namespace
{

// Without a measured length there is one slice, as long as the clearance length. Otherwise the number of slices is odd,
// so that the sample is in the middle of the middle slice.
Slices makeSlices(const ShellConfig& config, double spacing)
{
  Slices slices;
  slices.thickness = config.clearance_length;
  if (config.measure_length) {
    constexpr double kPointsPerSlice = 1.5;  // a thinner slice could fall between two rows of points and look empty
    slices.thickness = std::max(config.length_resolution, kPointsPerSlice * spacing);
    slices.count = 2 * static_cast<std::size_t>(config.max_length / 2 / slices.thickness) + 1;
  }
  slices.begin = -slices.thickness * static_cast<double>(slices.count) / 2;
  return slices;
}

PlaneMoments planeMoments(const PlaneMomentParts& parts)
{
  std::array<double, kPlaneMoments> sums;
  for (int m = 0; m < kPlaneMoments; ++m) {
    sums[m] = std::accumulate(std::begin(parts.of[m]), std::end(parts.of[m]), 0.0);
  }
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], sums[7], sums[8]};
}

}  // namespace

DirectedSearch::DirectedSearch(const ShellSurroundings& surroundings, const HandGeometry& hand,
                               const ShellConfig& config, ViewSlices& views, std::vector<SliceCounts>& counts)
    : surroundings_(surroundings),
      hand_(hand),
      config_(config),
      slices_(makeSlices(config, surroundings.spacing)),
      thresholds_(pointThresholds(config, surroundings.spacing)),
      views_(views),
      counts_(counts)
{
  counts_.resize(slices_.count);
}

/// Gathers the points around a cylinder's axis, unless the points that were gathered before will do.
void DirectedSearch::lookAlong(const FittedCylinder& cylinder)
{
  constexpr double kLargestShift = 0.004;  // m, across the axis, by recentering
  cylinder_ = cylinder;
  if (frame_ && (cylinder.origin - asVector(frame_->origin)).norm() <= kLargestShift) {
    return;
  }
  frame_ = axisFrame(cylinder.origin, cylinder.axis, acrossAxis(cylinder.axis));
  const double reach = hand_.capture_radius + hand_.finger_thickness + (config_.recenter ? kLargestShift : 0.0);
  views_.start(surroundings_, *frame_, slices_, reach);
}

ShellSearchResult DirectedSearch::about(const FittedCylinder& cylinder)
{
  ShellSearchResult result;
  if (!(cylinder.radius <= hand_.capture_radius)) {
    return result;
  }
  lookAlong(cylinder);
  const auto steps = static_cast<std::size_t>((hand_.capture_radius - cylinder.radius) / config_.radius_step) + 1;
  for (std::size_t j = 0; j < steps; ++j) {
    const double radius = cylinder.radius + config_.radius_step * static_cast<double>(j);
    const ShellBounds shell = boundsOf(radius);
    Extent extent = config_.measure_length ? measuredExtent(shell) : clearanceExtent(shell);
    if (!clearAndOccupied(extent)) {
      continue;
    }
    if (config_.measure_length) {
      extent = refinedExtent(extent, shell);
      if (extent.length() < config_.min_length || !clearAndOccupied(extent)) {
        result.status = ShellSearchResult::too_short;
        continue;
      }
    }
    result.status = ShellSearchResult::found;
    result.axis = cylinder.axis;
    result.centroid = cylinder.origin + (extent.begin + extent.end) / 2 * cylinder.axis;
    result.inner_radius = radius;
    result.length = extent.length();
    result.points_inside = extent.inside;
    result.points_in_gap = extent.in_gap;
    found_ = extent;
    found_bounds_ = shell;
    return result;
  }
  return result;
}

/// The direction stays. The radius is that of the surface, increased so that a whole number of steps leads from it to
/// the capture radius. Thus the last shell that is tried is the largest that the hand can enclose.
std::optional<FittedCylinder> DirectedSearch::refit() const
{
  ShellBounds shell = found_bounds_;
  shell.begin = found_.begin;
  shell.end = found_.end;
  PlaneMomentParts parts;
  for (std::size_t slice = found_.first_slice; slice <= found_.last_slice; ++slice) {
    views_.visitPoints(slice, shell.reach, [&](const AxisPoints& points) { addMoments(points, shell, parts); });
  }
  const auto circle = fitCircleTaubin(planeMoments(parts));
  if (!circle) {
    return std::nullopt;
  }
  FittedCylinder refitted = cylinder_;
  refitted.origin = asVector(frame_->origin) + circle->center.x() * asVector(frame_->first) +
                    circle->center.y() * asVector(frame_->second);
  const double room = hand_.capture_radius - circle->radius;
  constexpr double kRounding = 1.0 + 1e-12;  // else rounding could make about() count one step less
  const double whole_steps = std::floor(room / config_.radius_step) * config_.radius_step * kRounding;
  refitted.radius = room >= 0.0 ? std::max(0.0, hand_.capture_radius - whole_steps) : circle->radius;
  return refitted;
}

/// A line through the centres of circles, one fitted to each slice's points within the capture radius. Each centre has
/// the number of these points as its weight.
std::optional<FittedCylinder> DirectedSearch::straightened() const
{
  if (!frame_) {
    return std::nullopt;
  }
  ShellBounds shell = boundsOf(hand_.capture_radius);
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero(), middles = Eigen::Matrix2d::Zero();
  double points = 0.0, radius = 0.0;
  for (std::size_t slice = 0; slice < slices_.count; ++slice) {
    shell.begin = slices_.beginOf(slice);
    shell.end = slices_.endOf(slice);
    const double along = (shell.begin + shell.end) / 2;
    if (std::abs(along) > config_.clearance_length / 2) {
      continue;
    }
    PlaneMomentParts parts;
    views_.visitPoints(slice, shell.reach, [&](const AxisPoints& view) { addMoments(view, shell, parts); });
    const PlaneMoments moments = planeMoments(parts);
    const auto circle = fitCircleTaubin(moments);
    if (circle && circle->radius <= hand_.capture_radius) {
      const Eigen::Vector2d row(1.0, along);
      products += moments.count * row * row.transpose();
      middles += moments.count * circle->center * row.transpose();
      points += moments.count;
      radius += moments.count * circle->radius;
    }
  }
  const double spread = points * config_.clearance_length;
  if (!(products.determinant() > 1e-3 * spread * spread)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d line = middles * products.inverse();  // columns: place at the sample, and slope along the axis
  const Eigen::Vector3d first = asVector(frame_->first), second = asVector(frame_->second);
  FittedCylinder result;
  result.axis = (asVector(frame_->axis) + line(0, 1) * first + line(1, 1) * second).normalized();
  result.origin = asVector(frame_->origin) + line(0, 0) * first + line(1, 0) * second;
  result.radius = radius / points;
  return result;
}

ShellBounds DirectedSearch::boundsOf(double inner_radius) const
{
  const Eigen::Vector3d shift = cylinder_.origin - asVector(frame_->origin);
  ShellBounds shell;
  shell.center[0] = shift.dot(asVector(frame_->first));
  shell.center[1] = shift.dot(asVector(frame_->second));
  shell.begin = slices_.beginOf(0);
  shell.end = slices_.endOf(slices_.count - 1);
  const double outer_radius = inner_radius + hand_.finger_thickness;
  shell.squared_inner = inner_radius * inner_radius;
  shell.squared_outer = outer_radius * outer_radius;
  shell.reach = outer_radius + std::hypot(shell.center[0], shell.center[1]);
  shell.squared_filled = -1.0;
  if (config_.min_fill > 0.0) {
    const double depth = cylinder_.origin.z();
    const double depth_error = surroundings_.image != nullptr ? config_.depth_error * depth * depth : 0.0;
    const double filled = std::min(config_.min_fill * inner_radius, inner_radius - depth_error);
    shell.squared_filled = filled < 0.0 ? -1.0 : filled * filled;
  }
  return shell;
}

bool DirectedSearch::clearAndOccupied(const Extent& extent) const
{
  const double lengths = std::max(1.0, extent.length() / config_.clearance_length);
  return extent.inside >= lengths * thresholds_.min_points_inside &&
         extent.in_gap + extent.hidden_in_gap < lengths * thresholds_.gap_points_to_block;
}

/// Whether no sensor could see any of a slice.
bool DirectedSearch::unseen(std::size_t slice) const
{
  const std::vector<OtherView>* others = surroundings_.others;
  return unseen(slice, surroundings_.image, Eigen::Isometry3d::Identity()) &&
         (others == nullptr || std::all_of(others->begin(), others->end(), [&](const OtherView& other) {
            return other.image == nullptr || unseen(slice, other.image, other.T_other_this);
          }));
}

/// Whether this sensor could not see it: its pixels measured nothing, or something in front of the axis by more than
/// the capture radius.
bool DirectedSearch::unseen(std::size_t slice, const RangeImage* image, const Eigen::Isometry3d& T_image_this) const
{
  if (image == nullptr) {
    return false;
  }
  const auto seen = [&](const Eigen::Vector3d& point) {
    const auto pixel = image->pixel(point);
    return pixel && image->cloud().measured(*pixel) &&
           image->cloud().point(*pixel).cast<double>().norm() > point.norm() - hand_.capture_radius;
  };
  const double along = (slices_.beginOf(slice) + slices_.endOf(slice)) / 2;
  const Eigen::Vector3d origin = T_image_this * cylinder_.origin, axis = T_image_this.linear() * cylinder_.axis;
  const Eigen::Vector3d middle = origin + along * axis;
  const Eigen::Vector3d across = 0.5 * cylinder_.radius * axis.cross(origin).normalized();
  return !seen(middle - across) && !seen(middle) && !seen(middle + across);
}

/// Over the clearance length, which is one slice.
DirectedSearch::Extent DirectedSearch::clearanceExtent(const ShellBounds& shell) const
{
  Extent extent;
  extent.begin = shell.begin;
  extent.end = shell.end;
  extent.add(views_.count(0, shell));
  return extent;
}

/// Whether a slice is occupied inside and clear around. A slice of which no sensor could see anything is taken to be
/// occupied.
bool DirectedSearch::graspable(std::size_t slice, const ShellBounds& shell) const
{
  const double points_to_block =
      evidenceThreshold(2.0 * thresholds_.gap_points_to_block * slices_.thickness / config_.clearance_length);
  const SliceCounts& counts = counts_[slice] = views_.count(slice, shell);
  const std::uint32_t inside = counts.points.inside;
  return counts.inGap() + counts.hiddenInGap() < points_to_block &&
         (inside > counts.points.short_of_filled || (inside == 0 && unseen(slice)));
}

/// The row of slices around the sample that are all occupied inside and clear around.
DirectedSearch::Extent DirectedSearch::measuredExtent(const ShellBounds& shell) const
{
  Extent extent;
  const std::size_t middle = slices_.count / 2;
  if (!graspable(middle, shell)) {
    return extent;
  }
  extent.first_slice = extent.last_slice = middle;
  while (extent.first_slice > 0 && graspable(extent.first_slice - 1, shell)) {
    --extent.first_slice;
  }
  while (extent.last_slice + 1 < slices_.count && graspable(extent.last_slice + 1, shell)) {
    ++extent.last_slice;
  }
  extent.begin = slices_.beginOf(extent.first_slice);
  extent.end = slices_.endOf(extent.last_slice);
  for (std::size_t slice = extent.first_slice; slice <= extent.last_slice; ++slice) {
    extent.add(counts_[slice]);
  }
  return extent;
}

/// Shortens an extent of whole slices to its outermost points inside the shell. Each of these stands for a surface that
/// continues by half the distance between points. The result is within the given extent and within the largest length
/// that is measured.
DirectedSearch::Extent DirectedSearch::refinedExtent(const Extent& extent, ShellBounds shell) const
{
  std::size_t first = extent.first_slice, last = extent.last_slice;
  while (first < last && counts_[first].points.inside == 0) {
    ++first;
  }
  while (first < last && counts_[last].points.inside == 0) {
    --last;
  }
  const double margin = std::max(surroundings_.spacing / 2, 1e-6);
  Extent refined;
  refined.first_slice = extent.first_slice;
  refined.last_slice = extent.last_slice;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  AlongRange occupied{kInfinity, -kInfinity};
  views_.visitPoints(first, shell.reach, [&](const AxisPoints& points) {
    occupied.first = std::min(occupied.first, insideRange(points, shell).first);
  });
  views_.visitPoints(last, shell.reach, [&](const AxisPoints& points) {
    occupied.last = std::max(occupied.last, insideRange(points, shell).last);
  });
  refined.begin = std::max({occupied.first - margin, extent.begin, -config_.max_length / 2});
  refined.end = std::min({occupied.last + margin, extent.end, config_.max_length / 2});
  shell.begin = refined.begin;
  shell.end = refined.end;
  for (std::size_t slice = extent.first_slice; slice <= extent.last_slice; ++slice) {
    const bool whole = slices_.beginOf(slice) >= refined.begin && slices_.endOf(slice) <= refined.end;
    refined.add(whole ? counts_[slice] : views_.count(slice, shell));
  }
  return refined;
}

}  // namespace grasp_affordances
