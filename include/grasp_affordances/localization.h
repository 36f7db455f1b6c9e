#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// An enveloping grasp affordance: the object's surface is within `inner_radius` of the axis, and a gap around it, as
/// thick as a finger, is clear of points. Lengths in metres, in the cloud's frame.
struct Shell
{
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< on the axis, in the middle of the length
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();     ///< unit; its component of largest magnitude is positive
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();   ///< unit, at right angles to the axis, towards the sensor's
                                                       ///< side; NaN where the sensor's place is not known
  double inner_radius = 0.0;                           ///< m, from the axis to the gap
  double thickness = 0.0;                              ///< m, of the gap: that of the finger
  double length = 0.0;         ///< m, measured extent along the axis; the clearance length where none is measured
  double curvature = 0.0;      ///< 1/m, median over the neighborhood; NaN where the estimator measures none
  double observed_free = 0.0;  ///< in [0, 1], share of the gap that the sensor saw through; NaN without a range image
  std::uint32_t points_inside = 0;  ///< cloud points over the length, at most inner_radius from the axis
  std::uint32_t points_in_gap = 0;  ///< cloud points over the length, beyond inner_radius by at most the thickness
  std::uint32_t point_index = 0;    ///< row-major index of the sampled point in the cloud; several clouds are counted
                                    ///< one after the other
};

/// An axis has two directions. This is the one whose component of largest magnitude is positive.
Eigen::Vector3d withLargestComponentPositive(const Eigen::Vector3d& axis);

/// The shell in the frame that T leads to. Its axis points the other way where its largest component would be negative.
Shell transformed(Shell shell, const Eigen::Isometry3d& T);

/// Where a sample ended. Every sample ends in exactly one of these.
enum class Outcome : std::uint8_t
{
  too_few_points,  ///< the neighborhood cannot determine a quadric
  degenerate,      ///< no unique quadric or axis: exactly coplanar, collinear or coincident points
  occluded,        ///< something nearer to the sensor hides part of it
  low_curvature,   ///< median curvature below 1 / capture radius
  concave,         ///< curved towards the sensor
  no_shell,        ///< no radius up to the capture radius has a clear gap around enough points
  too_short,       ///< a clear gap, but over less than the minimum length
  unobserved_gap,  ///< a clear gap of which the sensor saw too little
  uncovered,       ///< a shell, but too little of its silhouette shows surface inside it
  out_of_time,     ///< not examined: the time budget was spent
  shell            ///< a cylindrical shell
};
constexpr std::size_t kOutcomes = 11;

/// Key of an outcome in `counts` ("too_few_points", ..., "shells").
const char* outcomeName(Outcome outcome);

/// Why no sample was drawn. Of several clouds that differ in this, the reason of the one that came nearest to a sample,
/// which is the last one in this list.
enum class NothingSampled : std::uint8_t
{
  no_cloud,          ///< no cloud was given, or none with a finite pose
  empty_cloud,       ///< the cloud has no points
  nothing_measured,  ///< all points are NaN, zero or infinite
  points_coincide,   ///< all measured points coincide
  outside_workspace  ///< no measured point lies within the workspace
};
constexpr std::size_t kNothingSampledReasons = 5;

/// What a warning says of such a reason: "the cloud is empty", ...
const char* describe(NothingSampled reason);

struct Localization;

/// A sentence for people that says why there is no handle and which parameter to look at. Empty where there is a
/// handle. The reason is where most samples ended; where these are flat, as before a table, where most of the others
/// did; or that an unorganized cloud is too sparse. May be called from any thread.
/// @param config  with which the result was found
std::string explainNothing(const Localization& localization, const Config& config);

/// Times of one localization, in milliseconds.
struct StageTimes
{
  double total = 0.0;          ///< ms of wall time, from the cloud in memory to the result
  double preparation = 0.0;    ///< ms of wall time: intrinsics, search structure, normals
  double neighborhoods = 0.0;  ///< ms, summed over the threads
  double occlusion = 0.0;      ///< ms, summed over the threads
  double fit = 0.0;            ///< ms, summed over the threads
  double shell = 0.0;          ///< ms, summed over the threads
  double handles = 0.0;        ///< ms of wall time, to group shells into handles
  double hand_poses = 0.0;     ///< ms of wall time
};

/// Result for one cloud.
struct Localization
{
  std::vector<Shell> shells;                      ///< in the order of their samples
  std::vector<GraspHandle> handles;               ///< in the order of their ids: the best first
  std::uint32_t points = 0;                       ///< measured points of the cloud, without those left out
  std::uint32_t sampled = 0;                      ///< samples drawn; the sum of `counts`
  std::uint32_t threads = 0;                      ///< number of threads that worked on it
  std::array<std::uint32_t, kOutcomes> counts{};  ///< indexed by Outcome
  StageTimes milliseconds;
  /// Distance (m) between the places that two views give to the same surfaces: the largest over all pairs of views. It
  /// tells how wrong the relative poses of the views are. NaN with fewer than two range images, and where they see no
  /// surface in common.
  double view_disagreement = std::numeric_limits<double>::quiet_NaN();
  NothingSampled nothing_sampled = NothingSampled::no_cloud;  ///< the reason, where `sampled` is 0
  std::vector<std::string> warnings;  ///< one line each: what of the cloud could not be used, and why
  /// Distance (m) between neighboring points, where there is no handle and no view is a range image; else NaN. There
  /// thresholds on numbers of points do not follow the density of points.
  double point_spacing = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace grasp_affordances
