#include "core/hand_poses/hand_pose_search.h"

#include "core/cloud/lattice.h"
#include "core/result/axis_frame.h"
#include "core/result/polyline.h"
#include "core/shell/evidence.h"
#include "core/shell/shell.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <optional>
#include <utility>

namespace grasp_affordances
{
namespace
{

bool anyImage(const PreparedViews& views)
{
  for (std::size_t view = 0; view < views.size(); ++view) {
    if (views[view].image) {
      return true;
    }
  }
  return false;
}

/// Direction in which a hand should approach, in the common frame; zero for any.
Eigen::Vector3d preferredApproach(const HandPosesConfig& config, const Eigen::Isometry3d& T_approach_common)
{
  const Eigen::Vector3d direction(config.approach_x, config.approach_y, config.approach_z);
  return direction.isZero(0.0) ? direction
                               : Eigen::Vector3d(T_approach_common.linear().transpose() * direction.normalized());
}

double score(double observed_free, double filled, double aligned, double off_middle)
{
  double sum = 1.0 - filled * filled, terms = 2.0;
  if (!std::isnan(aligned)) {
    sum += (1.0 + aligned) / 2;
    terms += 1.0;
  }
  sum += 1.0;
  sum -= off_middle;
  if (!std::isnan(observed_free)) {
    sum += observed_free;
    terms += 1.0;
  }
  return std::clamp(sum / terms, 0.0, 1.0);
}

}  // namespace

/// The corridor of a hand, see HandPoseSearch. In the hand's frame, metres.
struct HandPoseSearch::Corridor
{
  Corridor(const HandGeometry& hand, const HandPosesConfig& config, double handle_radius)
      : radius(std::min(handle_radius, hand.capture_radius)),
        begin(-(radius + hand.palm_depth + config.approach_distance)),
        half_span(radius + hand.finger_thickness),
        half_width(hand.palm_width / 2)
  {
  }

  /// Distance from the axis to the farthest point of the corridor.
  double reach() const { return std::hypot(begin, half_span); }

  /// The share that a sensor saw through, in any view with a range image.
  double observedFree(const PreparedViews& views, const Eigen::Isometry3d& T_common_hand) const;

  double radius, begin, half_span, half_width;
};

/// The lattice is made of lines along x. Each line has the same number of points, at even distances within the
/// corridor.
double HandPoseSearch::Corridor::observedFree(const PreparedViews& views, const Eigen::Isometry3d& T_common_hand) const
{
  constexpr int kAlong = 8, kAcross = 4, kWide = 3;
  constexpr std::size_t kPoints = kAlong * kAcross * kWide;
  std::bitset<kPoints> free;
  for (std::size_t view = 0; view < views.size(); ++view) {
    const std::optional<RangeImage>& image = views[view].image;
    if (!image) {
      continue;
    }
    const Eigen::Isometry3d T_view_hand = views.T_common_view(view).inverse() * T_common_hand;
    Lattice<kPoints> lattice;
    for (int b = 0; b < kAcross; ++b) {
      const double y = half_span * (2 * (b + 0.5) / kAcross - 1.0);
      const double end = -std::sqrt(std::max(0.0, radius * radius - y * y));
      for (int c = 0; c < kWide; ++c) {
        const double z = half_width * (2 * (c + 0.5) / kWide - 1.0);
        for (int a = 0; a < kAlong; ++a) {
          lattice.add(T_view_hand * Eigen::Vector3d(begin + (end - begin) * (a + 0.5) / kAlong, y, z));
        }
      }
    }
    lattice.visitMeasured(*image, [&](std::size_t i, const Eigen::Vector3d& point, const Eigen::Vector3d& measured) {
      free[i] = free[i] || measured.squaredNorm() > point.squaredNorm();
    });
  }
  return static_cast<double>(free.count()) / kPoints;
}

void HandPoseSearch::SurroundingPoints::add(const AxisPoints& points, double inner_radius)
{
  for (std::size_t i = 0; i < points.size; ++i) {
    if (points.first[i] * points.first[i] + points.second[i] * points.second[i] > inner_radius * inner_radius) {
      first.push_back(points.first[i]);
      second.push_back(points.second[i]);
    }
  }
}

void HandPoseSearch::search(const PreparedViews& views, const Config& config,
                            const Eigen::Isometry3d& T_approach_common, GraspHandle& handle)
{
  candidates_.clear();
  if (config.hand_poses.count > 0) {
    const Corridor corridor(config.hand, config.hand_poses, handle.inner_radius);
    findPlaces(config, preferredApproach(config.hand_poses, T_approach_common), handle);
    for (const Place& place : places_) {
      searchAt(place, views, config, corridor);
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return std::make_pair(-a.hand.score, a.rank) < std::make_pair(-b.hand.score, b.rank);
  });
  handle.hand_poses.clear();
  const Eigen::Isometry3d T_hand_tool = toolInHand(config.hand_poses);
  for (const Candidate& candidate : candidates_) {
    handle.hand_poses.push_back(candidate.hand);
    handle.hand_poses.back().pose = candidate.hand.pose * T_hand_tool;
  }
}

/// The middle comes first, then places farther out, on one side and on the other. All axes point the same way along the
/// handle.
void HandPoseSearch::findPlaces(const Config& config, const Eigen::Vector3d& preferred, const GraspHandle& handle)
{
  places_.clear();
  const auto add = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double off_middle) {
    constexpr double kAlong = 1e-3;
    const Eigen::Vector3d side = normalOrAny(axis, handle.normal);
    const Eigen::Vector3d normal = normalAcross(axis, side, kAlong * side.norm());
    const bool any = preferred.isZero(0.0);
    const Eigen::Vector3d first =
        any ? normal : directionAcross(axis, -preferred, kAlong * preferred.norm()).value_or(normal);
    const Eigen::Vector3d against_normal = isKnown(handle.normal) ? Eigen::Vector3d(-normal) : unknownNormal();
    places_.push_back({origin, axis, first, axis.cross(first), any ? against_normal : preferred, off_middle});
  };
  add(handle.centroid, handle.axis, 0.0);

  const double palm = config.hand.palm_width, length = lengthOf(handle.polyline);
  if (length < 2 * palm) {
    return;
  }
  const double end = (length - palm) / 2;  // from the middle to where the palm ends with the handle
  const int steps = end >= palm ? 2 : 1;
  const auto chordAt = [&](double distance) -> Eigen::Vector3d {
    return pointAt(handle.polyline, distance + palm / 2) - pointAt(handle.polyline, distance - palm / 2);
  };
  const double along = chordAt(length / 2).dot(handle.axis) < 0.0 ? -1.0 : 1.0;
  for (int step = 1; step <= steps; ++step) {
    for (const double side : {along, -along}) {
      const double off = end * step / steps, distance = length / 2 + side * off;
      const Eigen::Vector3d chord = along * chordAt(distance);
      if (chord.norm() > palm / 2) {
        add(pointAt(handle.polyline, distance), chord.normalized(), off / (length / 2));
      }
    }
  }
}

void HandPoseSearch::searchAt(const Place& place, const PreparedViews& views, const Config& config,
                              const Corridor& corridor)
{
  const std::size_t before = candidates_.size();
  findDirections(place, views, config.hand_poses, corridor);
  if (candidates_.size() == before) {
    return;
  }
  gatherAround(place, views, config, corridor);
  std::size_t accepted = before;
  for (std::size_t i = before; i < candidates_.size(); ++i) {
    const double filled = load(candidates_[i], corridor);
    if (filled < 1.0) {
      candidates_[accepted] = candidates_[i];
      GraspPose& hand = candidates_[accepted].hand;
      hand.score = score(hand.observed_free, filled, candidates_[accepted].aligned, place.off_middle);
      ++accepted;
    }
  }
  candidates_.resize(accepted);
}

/// Adds the directions in which the corridor was seen through well enough. Points in the corridor are judged later.
void HandPoseSearch::findDirections(const Place& place, const PreparedViews& views, const HandPosesConfig& wanted,
                                    const Corridor& corridor)
{
  const bool any = wanted.approach_x == 0.0 && wanted.approach_y == 0.0 && wanted.approach_z == 0.0;
  constexpr double kRounding = 1e-9;
  const double least_aligned = any ? -2.0 : std::cos(wanted.max_approach_angle) - kRounding;
  const bool sees = anyImage(views);
  for (int i = 0; i < wanted.count; ++i) {
    const double angle = 2 * M_PI * i / wanted.count;
    Candidate candidate;
    candidate.cosine = std::cos(angle);
    candidate.sine = std::sin(angle);
    const Eigen::Vector3d approach = -(candidate.cosine * place.first + candidate.sine * place.second);
    candidate.aligned = approach.dot(place.preferred);
    if (candidate.aligned < least_aligned) {
      continue;
    }
    GraspPose& hand = candidate.hand;
    hand.pose.linear() = rotationAlong(place.axis, approach);
    hand.pose.translation() = place.origin;
    hand.width = 2 * corridor.radius;
    if (sees) {
      hand.observed_free = corridor.observedFree(views, hand.pose);
      if (hand.observed_free < wanted.min_observed_free) {
        continue;
      }
    }
    candidate.rank = candidates_.size();
    candidates_.push_back(candidate);
  }
}

void HandPoseSearch::gatherAround(const Place& place, const PreparedViews& views, const Config& config,
                                  const Corridor& corridor)
{
  surroundings_.resize(views.size());
  for (std::size_t view = 0; view < views.size(); ++view) {
    const PreparedCloud& cloud = views[view];
    const Eigen::Isometry3d T_view_common = views.T_common_view(view).inverse();
    const AxisFrame frame =
        transformed(axisFrame(place.origin, place.axis, {place.first, place.second}), T_view_common);
    SurroundingPoints& around = surroundings_[view];
    around.first.clear();
    around.second.clear();
    const auto add = [&](const Cloud& points, const RangeImage* image) {
      around.add(
          cylinder_points_.gather(points, image, frame, corridor.reach(), -corridor.half_width, corridor.half_width),
          corridor.radius);
    };
    add(*cloud.cloud, cloud.image ? &*cloud.image : nullptr);
    if (cloud.hidden_search) {
      add(cloud.hidden.cloud(), &*cloud.hidden_image);
    }
    const double points_to_block =
        pointThresholds(config.shell, views.spacing(view, T_view_common * place.origin)).gap_points_to_block *
        config.hand.palm_width / config.shell.clearance_length;
    around.load_per_point = 1.0 / evidenceThreshold(points_to_block);
  }
}

/// The number of points in a corridor, over the number that blocks it.
double HandPoseSearch::load(const Candidate& candidate, const Corridor& corridor) const
{
  double load = 0.0;
  for (const SurroundingPoints& around : surroundings_) {
    std::size_t points = 0;
    for (std::size_t i = 0; i < around.first.size(); ++i) {
      const double x = -(candidate.cosine * around.first[i] + candidate.sine * around.second[i]);
      const double y = candidate.sine * around.first[i] - candidate.cosine * around.second[i];
      points += static_cast<std::size_t>((x <= 0.0) & (x >= corridor.begin) & (std::abs(y) <= corridor.half_span));
    }
    load += static_cast<double>(points) * around.load_per_point;
  }
  return load;
}

}  // namespace grasp_affordances
