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

/// Visits every field of a Config with its name, range, unit and description: the only list of parameters. YAML files,
/// ROS parameters, validation and documentation all go through it.
///
/// Calls `visit(name, field, range, unit, description)` for numbers (field: double&, int& or std::uint64_t&), and
/// `visit(name, field, description)` for switches and words (field: bool&, NeighborhoodKind&, Estimator& or
/// NormalsMode&). A name is a path: "hand/capture_radius" is the key capture_radius in the YAML map hand, and the
/// private ROS parameter ~hand/capture_radius. A description stands by itself, for lists are sorted in other ways.
template <typename ConfigT, typename Visitor>
void visitParameters(ConfigT& c, Visitor&& visit)
{
  using Real = Range<double>;
  using Count = Range<int>;
  visit("hand/capture_radius", c.hand.capture_radius, Real{0.002, 0.5}, "m",
        "radius of the largest circle that fits into the hand's capture region");
  visit("hand/finger_thickness", c.hand.finger_thickness, Real{0.001, 0.1}, "m",
        "thickness of the thickest finger, and so of the gap that must be clear around a surface");
  visit("hand/palm_width", c.hand.palm_width, Real{0.001, 0.5}, "m",
        "width of palm and fingers along the axis that the hand closes about");
  visit("hand/palm_depth", c.hand.palm_depth, Real{0.0, 1.0}, "m",
        "depth of the hand and of what is fixed behind it, from the palm's face back along the approach");

  visit("sampling/samples", c.sampling.samples, Count{1, 1000000}, "",
        "number of samples per cloud; the neighborhood of each is examined");
  visit("sampling/seed", c.sampling.seed, Range<std::uint64_t>{0, (std::uint64_t{1} << 53) - 1}, "",
        "seed of all random draws; every cloud starts with it afresh");
  visit("sampling/screen", c.sampling.screen,
        "draw samples first from points where the surface falls away on both sides, evenly over the image");
  visit("sampling/importance", c.sampling.importance,
        "draw samples in rounds, those of later rounds near the shells that earlier rounds found");
  visit("sampling/first_share", c.sampling.first_share, Real{0.01, 1.0}, "",
        "share of all samples that the first round draws, where sampling/importance is on");
  visit("sampling/uniform_share", c.sampling.uniform_share, Real{0.0, 1.0}, "",
        "share of the samples of later rounds that are drawn as in the first round, and not near shells");
  visit("sampling/spread", c.sampling.spread, Real{0.0, 0.5}, "m",
        "standard deviation, in each direction, of a sample drawn near a shell from the sample that found the shell");
  visit("sampling/time_budget_ms", c.sampling.time_budget_ms, Real{0.0, 60000.0}, "ms",
        "wall time per cloud after which no more samples are examined; 0: no limit. With a limit the result depends on "
        "the speed of the machine");

  const Real limit{-WorkspaceConfig::kNoLimit, WorkspaceConfig::kNoLimit};
  visit("workspace/min_x", c.workspace.min_x, limit, "m",
        "lower limit in x of the box that samples are drawn in; -100: no limit");
  visit("workspace/max_x", c.workspace.max_x, limit, "m",
        "upper limit in x of the box that samples are drawn in; 100: no limit");
  visit("workspace/min_y", c.workspace.min_y, limit, "m",
        "lower limit in y of the box that samples are drawn in; -100: no limit");
  visit("workspace/max_y", c.workspace.max_y, limit, "m",
        "upper limit in y of the box that samples are drawn in; 100: no limit");
  visit("workspace/min_z", c.workspace.min_z, limit, "m",
        "lower limit in z of the box that samples are drawn in; -100: no limit");
  visit("workspace/max_z", c.workspace.max_z, limit, "m",
        "upper limit in z of the box that samples are drawn in; 100: no limit");

  visit("neighborhood/kind", c.neighborhood.kind,
        "neighborhood of a sample: all points within a sphere (radius), or the k nearest points (knn)");
  visit("neighborhood/radius", c.neighborhood.radius, Real{0.0, 0.5}, "m",
        "radius of the sphere of a neighborhood of kind radius; 0: the capture radius");
  visit("neighborhood/k", c.neighborhood.k, Count{10, 100000}, "", "number of points of a neighborhood of kind knn");
  visit("neighborhood/min_points", c.neighborhood.min_points, Count{10, 100000}, "",
        "fewest points of a neighborhood that is examined");

  visit("occlusion/filter", c.occlusion.filter,
        "reject neighborhoods that something nearer to the sensor hides in part");
  visit("occlusion/max_points_in_front", c.occlusion.max_points_in_front, Count{0, 1000000}, "",
        "most points that may lie in front of a neighborhood, in the circle that its sphere covers in the image");
  visit("occlusion/min_distance_in_front", c.occlusion.min_distance_in_front, Real{0.0, 10.0}, "m",
        "distance by which a point must be nearer to the sensor than the closest point of a neighborhood to lie in "
        "front of it");

  visit("estimation/estimator", c.estimation.estimator,
        "estimator of the axis: the curvature axis of a Taubin quadric (taubin), or the paper's variations PCA (pca) "
        "and Normals (normals)");
  visit("estimation/curvature_points", c.estimation.curvature_points, Count{1, 10000}, "",
        "number of points of a neighborhood at which the curvature of the quadric is taken");
  visit("estimation/reject_concave", c.estimation.reject_concave,
        "reject neighborhoods whose centre of curvature is on the sensor's side, as inside a cup");
  visit("estimation/normals_radius", c.estimation.normals_radius, Real{0.001, 0.1}, "m",
        "radius of the sphere of points to which a surface normal is fitted, for the estimator normals");
  visit("estimation/normals_mode", c.estimation.normals_mode,
        "surface normals of a neighborhood that the estimator normals uses: all (exact), or those of every fourth row "
        "and column (sparse)");

  visit("shell/radius_step", c.shell.radius_step, Real{0.0001, 0.01}, "m",
        "step by which the radius of the shell grows while it is searched");
  visit("shell/clearance_length", c.shell.clearance_length, Real{0.001, 0.5}, "m",
        "length along the axis for which the thresholds for points in the gap and inside the shell hold");
  visit("shell/gap_points_to_block", c.shell.gap_points_to_block, Count{1, 1000000}, "",
        "number of points in the gap, over the clearance length, that block it");
  visit("shell/min_points_inside", c.shell.min_points_inside, Count{1, 1000000}, "",
        "fewest points inside the shell, over the clearance length, that are taken for a surface");
  visit("shell/measure_length", c.shell.measure_length,
        "measure the extent along the axis over which the shell is occupied inside and clear around; if not, it is the "
        "clearance length");
  visit("shell/min_length", c.shell.min_length, Real{0.0, 0.5}, "m",
        "shortest measured extent along the axis of a shell that is accepted");
  visit("shell/max_length", c.shell.max_length, Real{0.001, 1.0}, "m",
        "longest extent along the axis that is measured");
  visit("shell/length_resolution", c.shell.length_resolution, Real{0.0005, 0.05}, "m",
        "resolution of the extent along the axis that is measured");
  visit("shell/min_fill", c.shell.min_fill, Real{0.0, 0.99}, "",
        "share of the inner radius that the surface must reach all along a measured extent");
  visit("shell/depth_error", c.shell.depth_error, Real{0.0, 0.1}, "m",
        "allowance for noise at a depth of 1 m, growing with the square of the depth: by so much the surface may fall "
        "short of shell/min_fill");
  visit("shell/recenter", c.shell.recenter,
        "fit the cylinder again to the points inside a shell that was found, and search the shell again about it");
  visit("shell/straighten", c.shell.straighten,
        "with several views, where no shell is found: search again about the line through the middles of slices of the "
        "surface");
  visit("shell/continue_surfaces", c.shell.continue_surfaces,
        "continue surfaces that are seen on both sides of a shadow through it: there they block the gap");
  visit("shell/require_observed_gap", c.shell.require_observed_gap,
        "reject shells where the sensor saw through too small a share of the gap, see shell/min_observed_free");
  visit("shell/min_observed_free", c.shell.min_observed_free, Real{0.0, 1.0}, "",
        "least share of a shell's gap that the sensor must have seen through");
  visit("shell/min_coverage", c.shell.min_coverage, Real{0.0, 1.0}, "",
        "least share of a shell's silhouette in the image that must show surface inside the shell; 0: not judged");
  visit("shell/scale_with_density", c.shell.scale_with_density,
        "scale shell/gap_points_to_block and shell/min_points_inside with the density of points at the sample's range, "
        "but not below 2");
  visit("shell/reference_spacing", c.shell.reference_spacing, Real{0.0001, 0.1}, "m",
        "distance between the points of neighboring pixels at which shell/gap_points_to_block and "
        "shell/min_points_inside hold as given");

  const double pi = 3.14159265358979323846;
  visit("handles/max_angle", c.handles.max_angle, Real{0.0, pi / 2}, "rad",
        "largest angle between the axes of shells that follow one another along a handle");
  visit("handles/max_distance", c.handles.max_distance, Real{0.0, 0.1}, "m",
        "largest distance between the axes of shells that follow one another along a handle");
  visit("handles/max_radius_difference", c.handles.max_radius_difference, Real{0.0, 0.5}, "m",
        "largest difference between the inner radii of shells that follow one another along a handle");
  visit("handles/max_gap", c.handles.max_gap, Real{0.0, 0.5}, "m",
        "largest gap between the ends of shells on either side of a step of a handle's radius");
  visit("handles/min_support", c.handles.min_support, Count{1, 100000}, "", "fewest shells that make a handle");
  visit("handles/min_score", c.handles.min_score, Real{0.0, 1.0}, "", "lowest score of a handle that is reported");

  visit("hand_poses/count", c.hand_poses.count, Count{0, 360}, "",
        "number of directions of approach that are tried on each ring around a handle; 0: no hand poses");
  visit("hand_poses/approach_distance", c.hand_poses.approach_distance, Real{0.0, 1.0}, "m",
        "distance by which the hand moves forward to where it closes");
  visit("hand_poses/min_observed_free", c.hand_poses.min_observed_free, Real{0.0, 1.0}, "",
        "least share of the approach corridor that the sensor must have seen through");
  const Real component{-1.0, 1.0};
  visit("hand_poses/approach_x", c.hand_poses.approach_x, component, "",
        "x of the direction in which a hand should approach; x, y and z 0: any direction");
  visit("hand_poses/approach_y", c.hand_poses.approach_y, component, "",
        "y of the direction in which a hand should approach; x, y and z 0: any direction");
  visit("hand_poses/approach_z", c.hand_poses.approach_z, component, "",
        "z of the direction in which a hand should approach; x, y and z 0: any direction");
  visit("hand_poses/max_approach_angle", c.hand_poses.max_approach_angle, Real{0.0, pi}, "rad",
        "largest angle between the direction in which a hand should approach and that in which it does");
  const Real offset{-1.0, 1.0}, angle{-pi, pi};
  visit("hand_poses/tool_x", c.hand_poses.tool_x, offset, "m",
        "x of the tool's frame in the hand's frame; hand poses are poses of the tool's frame");
  visit("hand_poses/tool_y", c.hand_poses.tool_y, offset, "m",
        "y of the tool's frame in the hand's frame; hand poses are poses of the tool's frame");
  visit("hand_poses/tool_z", c.hand_poses.tool_z, offset, "m",
        "z of the tool's frame in the hand's frame; hand poses are poses of the tool's frame");
  visit("hand_poses/tool_roll", c.hand_poses.tool_roll, angle, "rad",
        "turn of the tool's frame about the hand's x axis, the first of three (roll, pitch, yaw; fixed axes)");
  visit("hand_poses/tool_pitch", c.hand_poses.tool_pitch, angle, "rad",
        "turn of the tool's frame about the hand's y axis, the second of three (roll, pitch, yaw; fixed axes)");
  visit("hand_poses/tool_yaw", c.hand_poses.tool_yaw, angle, "rad",
        "turn of the tool's frame about the hand's z axis, the third of three (roll, pitch, yaw; fixed axes)");

  visit("tracking/track", c.tracking.track, "track handles: they keep their id from cloud to cloud, and are smoothed");
  visit("tracking/max_distance", c.tracking.max_distance, Real{0.0, 1.0}, "m",
        "largest distance, at right angles to its axis, by which a handle may move from one cloud to the next");
  visit("tracking/max_angle", c.tracking.max_angle, Real{0.0, pi / 2}, "rad",
        "largest angle by which a handle may turn from one cloud to the next");
  visit("tracking/smoothing_time", c.tracking.smoothing_time, Real{0.0, 60.0}, "s",
        "time over which the pose and the sizes of a handle are averaged; 0: they are not smoothed");
  visit("tracking/min_hits", c.tracking.min_hits, Count{1, 1000}, "",
        "number of clouds in which a new handle must be found before it is reported");
  visit("tracking/lifetime", c.tracking.lifetime, Real{0.0, 60.0}, "s",
        "time for which a handle that is not found any more is still reported");

  visit("threads", c.threads, Count{0, 256}, "",
        "number of threads that work on a cloud; 0: one per core; no influence on the result");
}

/// The words for the values of an enumeration, in the order of its values.
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

/// The value that a word stands for. @throw ParameterError, with `name`, for a word that stands for none.
template <typename Enum>
Enum enumFromWord(const std::string& name, const std::string& word);
template <>
NeighborhoodKind enumFromWord<NeighborhoodKind>(const std::string& name, const std::string& word);
template <>
Estimator enumFromWord<Estimator>(const std::string& name, const std::string& word);
template <>
NormalsMode enumFromWord<NormalsMode>(const std::string& name, const std::string& word);

/// Reads parameters from YAML text. Parameters that the text does not give keep the value of the preset that its key
/// `preset` names, or else of `base`. The result is validated.
/// @throw ParameterError for text that is no YAML map, an unknown key, a value of the wrong type or outside its range
Config configFromYaml(const std::string& text, const Config& base);

/// As configFromYaml, from a file. @throw ParameterError also for a file that cannot be read.
Config configFromYamlFile(const std::string& path, const Config& base);

}  // namespace grasp_affordances
