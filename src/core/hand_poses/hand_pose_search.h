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

/// Finds poses of an open hand on rings around a handle's axis. The hand reaches each of them in a straight line,
/// through a corridor that is free of points and that a sensor saw through.
///
/// **The hand.** At the end of the approach its frame has x along the approach, z along the handle's axis, and its
/// origin on the axis. Let r be the handle's inner radius and t the finger's thickness. Fingers and thumb are at r <=
/// |y| <= r + t. The face of the palm is at x = -r, and the palm extends back from there by its depth. All have the
/// palm's width along z.
///
/// **The corridor** is what palm and fingers pass through on their way in: -(r + palm depth + approach distance) <= x
/// <= 0, |y| <= r + t, |z| <= palm width / 2. The part within r of the axis, which holds the object, does not belong to
/// it. Nor does the part beyond the axis, x > 0: the shell's gap is clear there already.
///
/// **Points in the corridor.** A corridor is blocked by the number of points that blocks a shell's gap over a clearance
/// length equal to the palm's width. Points of all views count, measured ones and those of hidden surfaces (see
/// HiddenSurfaces). Views may differ in the density of their points: each point counts as 1 over the number that would
/// block the corridor in its own view.
///
/// **Observed free space.** A fixed lattice of points in the corridor gives the share that a sensor saw through: the
/// share of points whose pixel measured a range beyond them, in any view with a range image. It must be
/// `min_observed_free` or more. Without any range image it is not known, and the points in the corridor decide alone.
///
/// **Places.** The hand is tried in the middle of every handle, at the ends of a handle that is at least twice as long
/// as the palm is wide, and halfway to the ends of a longer one. These are at most five places, at least half a palm's
/// width apart. At each of them z is the direction of the axis over the palm's width. The inner radius is that of the
/// handle's middle. Where a handle is thicker, its own surface blocks the hand.
///
/// **Directions.** `count` directions of approach are evenly spaced around the axis. The hand's first direction is from
/// the side of the handle's normal, which is the sensor's. Where the normal is not known, it is any one. With a
/// preferred direction of approach the first is the one nearest to it.
///
/// **Score**: the mean of
/// - the share of the corridor that was seen to be free; left out where it is not known,
/// - 1 - (points in the corridor / points that would block it)^2,
/// - (1 + cos a) / 2, where a is the angle between the approach and the preferred direction, or without one between the
///   approach and the opposite of the normal; left out where neither is known,
/// - 1 - distance from the middle along the axis / half the handle's length.
///
/// Poses are sorted by falling score. Of poses with the same score the one nearer to the middle comes first, then the
/// one whose direction was tried first. The result depends on clouds, handle and configuration alone.
///
/// An instance keeps its working memory and serves one thread at a time.
class HandPoseSearch
{
public:
  /// Sets handle.hand_poses: poses of the tool, see GraspPose.
  /// @param T_approach_common  from the common frame of the views to the frame in which HandPosesConfig gives the
  /// direction of approach
  void search(const PreparedViews& views, const Config& config, const Eigen::Isometry3d& T_approach_common,
              GraspHandle& handle);

private:
  /// A place along a handle at which a hand closes, and its frame: directions of approach turn about `axis`, from
  /// `first`.
  struct Place
  {
    Eigen::Vector3d origin, axis, first, second;  // m, on the axis; the others are orthonormal
    Eigen::Vector3d preferred;                    // direction of approach, unit; NaN where none is
    double off_middle;                            // 0 in the middle of the handle, 1 at its end
  };

  /// A hand pose that is examined.
  struct Candidate
  {
    GraspPose hand;
    double cosine = 1.0, sine = 0.0;  // of the angle of the side it comes from, in the place's frame
    double aligned = 1.0;             // cosine of the angle between approach and preferred approach; NaN without one
    std::size_t rank = 0;             // among those of equal score
  };

  /// The points of a view around a place, without those of the object.
  struct SurroundingPoints
  {
    void add(const AxisPoints& points, double inner_radius);

    std::vector<double> first, second;  // across the axis, m
    double load_per_point = 0.0;        // 1 over the number that blocks a corridor
  };

  struct Corridor;

  void findPlaces(const Config& config, const Eigen::Vector3d& preferred, const GraspHandle& handle);
  void searchAt(const Place& place, const PreparedViews& views, const Config& config, const Corridor& corridor);
  void findDirections(const Place& place, const PreparedViews& views, const HandPosesConfig& wanted,
                      const Corridor& corridor);
  void gatherAround(const Place& place, const PreparedViews& views, const Config& config, const Corridor& corridor);
  double load(const Candidate& candidate, const Corridor& corridor) const;

  std::vector<Place> places_;
  std::vector<Candidate> candidates_;  // those of the current place come last
  CylinderPoints cylinder_points_;
  std::vector<SurroundingPoints> surroundings_;  // of each view
};

}  // namespace grasp_affordances
