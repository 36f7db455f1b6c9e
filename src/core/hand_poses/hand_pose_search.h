#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include "core/shell/cylinder_points.h"
#include "core/views/prepared_views.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Poses of an open hand on rings around a handle's axis, which the hand reaches in a straight line through seen or
/// free space.
///
/// **The hand.** Its frame at the end of the approach: x along the approach, z along the handle's axis, the origin on
/// it. With r = the handle's inner radius and t = the finger's thickness, fingers and thumb stand at r <= |y| <= r + t,
/// the palm's face is at x = -r and the palm reaches back from there by its depth. Along z all have the palm's width.
///
/// **The corridor** is what palm and fingers sweep on their way in: -(r + palm depth + approach distance) <= x <= 0,
/// |y| <= r + t, |z| <= palm width / 2, without what is within r of the axis, the object itself. What is beyond the
/// axis, x > 0, is left to the shell: there its gap is clear already.
///
/// A corridor is blocked by as many points of any view, measured or hidden (see continueSurfaces), as block a shell's
/// gap over a clearance length equal to the palm's width; where views differ in the density of points, a point counts
/// as one over the number that would block it in its own view. A fixed lattice of points in the corridor tells how much
/// of it a sensor saw through: the share of those whose pixel measured a range beyond them, in any view with a range
/// image. Less than `min_observed_free` is not enough; without any range image points alone decide.
///
/// **Places.** Every handle is tried in its middle; one that is at least twice as long as the palm is wide also at its
/// ends, and a longer one halfway there: at most five places, at least half a palm's width apart. There z is the
/// direction of the axis over the palm's width. The handle's inner radius is that of its middle: where a handle is
/// thicker, its own surface blocks the hand.
///
/// **Directions.** `count` of them evenly around the axis. The first is that from the handle's normal, the sensor's
/// side, or where there is a preferred direction of approach, the one nearest to it.
///
/// **Score**: the mean of
/// - the share of the corridor that was seen to be free, unless nothing is known of it,
/// - 1 - (points in the corridor / points that would block it)^2,
/// - (1 + cos a) / 2, with a the angle between approach and preferred direction, or between approach and the direction
///   opposite to the normal where there is none,
/// - 1 - distance from the middle along the axis / half the handle's length.
///
/// Poses are sorted by falling score; of equal ones that nearer to the middle, then that of the earlier direction,
/// comes first. The result depends on clouds, handle and configuration alone. Keeps its memory: one instance per
/// thread.
class HandPoseSearch
{
public:
  /// Sets handle.hand_poses, those of the tool; see GraspPose.
  /// @param T_approach_common  to the frame in which HandPosesConfig gives the direction of approach
  void search(const PreparedViews& views, const Config& config, const Eigen::Isometry3d& T_approach_common,
              GraspHandle& handle);

private:
  /// Where along a handle a hand closes: a frame that the directions of approach turn in.
  struct Place
  {
    Eigen::Vector3d origin, axis, first, second;  // on the axis; unit, orthonormal
    Eigen::Vector3d preferred;                    // approach, unit
    double off_middle;                            // along the axis: 0 in the middle, 1 at the end
  };

  /// A direction that a hand comes from.
  struct Candidate
  {
    GraspPose hand;
    double cosine = 1.0, sine = 0.0;  // of the direction's angle in the place's frame
    double aligned = 1.0;             // cosine of the angle between approach and preferred approach
    std::size_t rank = 0;             // among those of equal score
  };

  /// The points of a view about a place that are no part of the object.
  struct SurroundingPoints
  {
    void add(const AxisPoints& points, double inner_radius);

    std::vector<double> first, second;  // across the axis, m
    double load_per_point = 0.0;
  };

  struct Corridor;

  void findPlaces(const Config& config, const Eigen::Vector3d& preferred, const GraspHandle& handle);
  void searchAt(const Place& place, const PreparedViews& views, const Config& config, const Corridor& corridor);
  void findDirections(const Place& place, const PreparedViews& views, const HandPosesConfig& wanted,
                      const Corridor& corridor);
  void gatherAround(const Place& place, const PreparedViews& views, const Config& config, const Corridor& corridor);
  double load(const Candidate& candidate, const Corridor& corridor) const;

  std::vector<Place> places_;
  std::vector<Candidate> candidates_;  // the ones that were accepted first
  CylinderPoints cylinder_points_;
  std::vector<SurroundingPoints> surroundings_;  // by view
};

}  // namespace grasp_affordances
