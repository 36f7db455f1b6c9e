#pragma once

#include "grasp_affordances/config.h"

#include <cstdint>
#include <limits>
#include <string>

namespace grasp_affordances
{

/// Closed interval of allowed values.
template <typename T>
struct Range
{
  T min;
  T max;
};

/// Name, range, unit and description of every field of a Config: the only list of parameters. YAML files, ROS
/// parameters, validation and documentation all go through it.
///
/// Calls `visit(name, field, range, unit, description)` for numbers (field: double&, int& or std::uint64_t&) and
/// `visit(name, field, description)` for bool&, NeighborhoodKind&, Estimator& and
/// NormalsMode&. Names are paths:
/// "hand/capture_radius" is the key capture_radius in the YAML map hand, and the private ROS parameter
/// ~hand/capture_radius.
template <typename ConfigT, typename Visitor>
void visitParameters(ConfigT& c, Visitor&& visit)
{
  using Real = Range<double>;
  using Count = Range<int>;
  visit("hand/capture_radius", c.hand.capture_radius, Real{0.002, 0.5}, "m",
        "radius of the largest circle inscribed in the hand's capture region");
  visit("hand/finger_thickness", c.hand.finger_thickness, Real{0.001, 0.1}, "m",
        "thickness of the thickest finger: the gap that must be clear");
  visit("hand/palm_width", c.hand.palm_width, Real{0.001, 0.5}, "m",
        "of palm and fingers along the axis that the hand closes about");
  visit("hand/palm_depth", c.hand.palm_depth, Real{0.0, 1.0}, "m",
        "from the palm's face back: what follows the palm along its approach");

  visit("sampling/samples", c.sampling.samples, Count{1, 1000000}, "", "neighborhoods drawn per cloud");
  visit("sampling/seed", c.sampling.seed, Range<std::uint64_t>{0, (std::uint64_t{1} << 53) - 1}, "",
        "of the random draws, the same for every cloud");
  visit("sampling/screen", c.sampling.screen,
        "sample first where the cloud falls away on both sides, evenly over the image");
  visit("sampling/importance", c.sampling.importance,
        "draw samples of later rounds near the shells that earlier ones found");
  visit("sampling/first_share", c.sampling.first_share, Real{0.01, 1.0}, "",
        "of the samples, those of the first round");
  visit("sampling/uniform_share", c.sampling.uniform_share, Real{0.0, 1.0}, "",
        "of the samples of later rounds, those that are drawn like the first ones");
  visit("sampling/spread", c.sampling.spread, Real{0.0, 0.5}, "m",
        "standard deviation of a sample near a shell from that shell's sample");
  visit("sampling/time_budget_ms", c.sampling.time_budget_ms, Real{0.0, 60000.0}, "ms",
        "of wall time after which no more samples are examined; 0: no limit. With a limit results may differ");

  const Real limit{-WorkspaceConfig::kNoLimit, WorkspaceConfig::kNoLimit};
  visit("workspace/min_x", c.workspace.min_x, limit, "m", "least x of the box that samples are drawn in");
  visit("workspace/max_x", c.workspace.max_x, limit, "m", "largest x of the box that samples are drawn in");
  visit("workspace/min_y", c.workspace.min_y, limit, "m", "least y of the box that samples are drawn in");
  visit("workspace/max_y", c.workspace.max_y, limit, "m", "largest y of the box that samples are drawn in");
  visit("workspace/min_z", c.workspace.min_z, limit, "m", "least z of the box that samples are drawn in");
  visit("workspace/max_z", c.workspace.max_z, limit, "m", "largest z of the box that samples are drawn in");

  visit("neighborhood/kind", c.neighborhood.kind, "all points within a sphere, or the k nearest");
  visit("neighborhood/radius", c.neighborhood.radius, Real{0.0, 0.5}, "m", "of the sphere; 0: the capture radius");
  visit("neighborhood/k", c.neighborhood.k, Count{10, 100000}, "", "size of a k nearest neighborhood");
  visit("neighborhood/min_points", c.neighborhood.min_points, Count{10, 100000}, "",
        "a neighborhood with fewer is not fitted");

  visit("occlusion/filter", c.occlusion.filter, "reject neighborhoods that something nearer hides in part");
  visit("occlusion/max_points_in_front", c.occlusion.max_points_in_front, Count{0, 1000000}, "",
        "more nearer points than this, seen in the direction of the neighborhood's sphere, reject it");
  visit("occlusion/min_distance_in_front", c.occlusion.min_distance_in_front, Real{0.0, 10.0}, "m",
        "by which such a point is nearer than the closest point of the neighborhood");

  visit("estimation/estimator", c.estimation.estimator, "of the axis");
  visit("estimation/curvature_points", c.estimation.curvature_points, Count{1, 10000}, "",
        "points of the neighborhood at which the quadric's curvature is taken");
  visit("estimation/reject_concave", c.estimation.reject_concave,
        "reject neighborhoods whose centre of curvature is on the sensor's side");
  visit("estimation/normals_radius", c.estimation.normals_radius, Real{0.001, 0.1}, "m",
        "support of the surface normals of the Normals variation");
  visit("estimation/normals_mode", c.estimation.normals_mode,
        "of a neighborhood's surface normals all, or those of every fourth row and column");

  visit("shell/radius_step", c.shell.radius_step, Real{0.0001, 0.01}, "m", "by which the shell grows");
  visit("shell/clearance_length", c.shell.clearance_length, Real{0.001, 0.5}, "m",
        "along the axis, over which the gap is searched for points");
  visit("shell/gap_points_to_block", c.shell.gap_points_to_block, Count{1, 1000000}, "",
        "this many points in the gap over the clearance length block it");
  visit("shell/min_points_inside", c.shell.min_points_inside, Count{1, 1000000}, "",
        "fewer points inside the shell over the clearance length are no surface");
  visit("shell/measure_length", c.shell.measure_length,
        "measure the extent along the axis that is occupied inside and clear around");
  visit("shell/min_length", c.shell.min_length, Real{0.0, 0.5}, "m", "shortest measured extent that is accepted");
  visit("shell/max_length", c.shell.max_length, Real{0.001, 1.0}, "m", "extent beyond which nothing is measured");
  visit("shell/length_resolution", c.shell.length_resolution, Real{0.0005, 0.05}, "m", "of the measured extent");
  visit("shell/min_fill", c.shell.min_fill, Real{0.0, 0.99}, "",
        "share of the inner radius that the surface reaches all along a measured extent");
  visit("shell/depth_error", c.shell.depth_error, Real{0.0, 0.1}, "m",
        "at a depth of 1 m, growing with its square: by so much the surface may fall short of that");
  visit("shell/recenter", c.shell.recenter, "fit the cylinder anew to the points inside a shell, and search again");
  visit("shell/straighten", c.shell.straighten,
        "with several views, where no shell is found: search again about the line through the middles of slices");
  visit("shell/continue_surfaces", c.shell.continue_surfaces,
        "surfaces seen on both sides of a shadow go on through it, and block a gap there");
  visit("shell/require_observed_gap", c.shell.require_observed_gap,
        "require that the sensor saw through a share of the gap");
  visit("shell/min_observed_free", c.shell.min_observed_free, Real{0.0, 1.0}, "", "that share");
  visit("shell/min_coverage", c.shell.min_coverage, Real{0.0, 1.0}, "",
        "share of the silhouette that shows surface inside the shell; 0: not judged");
  visit("shell/scale_with_density", c.shell.scale_with_density,
        "thresholds that count points follow the density of points at the sample's range");
  visit("shell/reference_spacing", c.shell.reference_spacing, Real{0.0001, 0.1}, "m",
        "distance between neighboring pixels' points at which those thresholds hold as given");

  const double pi = 3.14159265358979323846;
  visit("handles/max_angle", c.handles.max_angle, Real{0.0, pi / 2}, "rad",
        "between the axes of shells that follow one another along a handle");
  visit("handles/max_distance", c.handles.max_distance, Real{0.0, 0.1}, "m", "between their axes");
  visit("handles/max_radius_difference", c.handles.max_radius_difference, Real{0.0, 0.5}, "m",
        "between their inner radii");
  visit("handles/max_gap", c.handles.max_gap, Real{0.0, 0.5}, "m",
        "between the ends of shells on either side of a step of the radius");
  visit("handles/min_support", c.handles.min_support, Count{1, 100000}, "", "shells; fewer are no handle");
  visit("handles/min_score", c.handles.min_score, Real{0.0, 1.0}, "", "handles with a lower score are left out");

  visit("hand_poses/count", c.hand_poses.count, Count{0, 360}, "",
        "directions of approach that are tried on each ring around a handle; 0: no hand poses");
  visit("hand_poses/approach_distance", c.hand_poses.approach_distance, Real{0.0, 1.0}, "m",
        "by which the hand moves forward to where it closes");
  visit("hand_poses/min_observed_free", c.hand_poses.min_observed_free, Real{0.0, 1.0}, "",
        "share of the approach corridor that the sensor saw through");
  const Real component{-1.0, 1.0};
  visit("hand_poses/approach_x", c.hand_poses.approach_x, component, "",
        "of the direction in which a hand should approach; all zero: any");
  visit("hand_poses/approach_y", c.hand_poses.approach_y, component, "", "of that direction");
  visit("hand_poses/approach_z", c.hand_poses.approach_z, component, "", "of that direction");
  visit("hand_poses/max_approach_angle", c.hand_poses.max_approach_angle, Real{0.0, pi}, "rad",
        "between that direction and a hand's approach");
  const Real offset{-1.0, 1.0}, angle{-pi, pi};
  visit("hand_poses/tool_x", c.hand_poses.tool_x, offset, "m",
        "of the tool's frame in the hand's: poses are the tool's");
  visit("hand_poses/tool_y", c.hand_poses.tool_y, offset, "m", "of the tool's frame in the hand's");
  visit("hand_poses/tool_z", c.hand_poses.tool_z, offset, "m", "of the tool's frame in the hand's");
  visit("hand_poses/tool_roll", c.hand_poses.tool_roll, angle, "rad", "of the tool's frame about the hand's x");
  visit("hand_poses/tool_pitch", c.hand_poses.tool_pitch, angle, "rad", "then about the hand's y");
  visit("hand_poses/tool_yaw", c.hand_poses.tool_yaw, angle, "rad", "then about the hand's z");

  visit("tracking/track", c.tracking.track, "handles keep their id from cloud to cloud, and are smoothed");
  visit("tracking/max_distance", c.tracking.max_distance, Real{0.0, 1.0}, "m",
        "at right angles to its axis, that a handle may move between clouds");
  visit("tracking/max_angle", c.tracking.max_angle, Real{0.0, pi / 2}, "rad", "that a handle may turn between clouds");
  visit("tracking/smoothing_time", c.tracking.smoothing_time, Real{0.0, 60.0}, "s",
        "over which a handle's pose and sizes are averaged; 0: not smoothed");
  visit("tracking/min_hits", c.tracking.min_hits, Count{1, 1000}, "",
        "clouds that a new handle must be found in before it is reported");
  visit("tracking/lifetime", c.tracking.lifetime, Real{0.0, 60.0}, "s",
        "for which a handle that is not found any more is still reported");

  visit("threads", c.threads, Count{0, 256}, "", "that work on a cloud; 0: one per core; no influence on the result");
}

/// Words that stand for the values of an enumeration, in the order of its values.
template <typename Enum>
const std::vector<std::string>& enumWords();
template <>
const std::vector<std::string>& enumWords<NeighborhoodKind>();  // radius, knn
template <>
const std::vector<std::string>& enumWords<Estimator>();  // taubin, pca, normals
template <>
const std::vector<std::string>& enumWords<NormalsMode>();  // exact, sparse

template <typename Enum>
const std::string& enumWord(Enum value)
{
  return enumWords<Enum>()[static_cast<std::size_t>(value)];
}

/// @throw ParameterError, with `name`, for a word that stands for no value.
template <typename Enum>
Enum enumFromWord(const std::string& name, const std::string& word);
template <>
NeighborhoodKind enumFromWord<NeighborhoodKind>(const std::string& name, const std::string& word);
template <>
Estimator enumFromWord<Estimator>(const std::string& name, const std::string& word);
template <>
NormalsMode enumFromWord<NormalsMode>(const std::string& name, const std::string& word);

/// Reads parameters from YAML text over the preset that its key `preset` names, else over `base`.
/// Keys that are missing keep their value; the values are validated.
/// @throw ParameterError for text that is no YAML map, an unknown key, a value of the wrong type or outside its range.
Config configFromYaml(const std::string& text, const Config& base);

/// As configFromYaml, from a file. @throw ParameterError also for a file that cannot be read.
Config configFromYamlFile(const std::string& path, const Config& base);

}  // namespace grasp_affordances
