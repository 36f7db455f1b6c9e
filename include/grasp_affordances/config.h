#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The hand, reduced to what an enveloping grasp needs (paper, section II).
struct HandGeometry
{
  double capture_radius = 0.026;    ///< m, radius of the largest circle that fits into the capture region
  double finger_thickness = 0.008;  ///< m, of the thickest finger or thumb in the opposition plane
  double palm_width = 0.03;  ///< m, width of palm and fingers along the opposition axis, which is the shell's axis
  double palm_depth = 0.06;  ///< m, from the palm's face back along the approach, with what is fixed behind it
};

/// The points around a sample that make up its neighborhood.
enum class NeighborhoodKind
{
  radius,  ///< all points within a sphere
  knn      ///< the k nearest points; the sphere's radius is then the distance to the k-th
};

/// How the axis of a neighborhood is estimated.
enum class Estimator
{
  taubin,  ///< curvature axis of the Taubin quadric (paper, Algorithm 1)
  pca,     ///< direction of largest variance of the points ("PCA variation")
  normals  ///< direction in which the surface normals vary least ("Normals variation")
};

/// How many surface normals the Normals variation looks at.
enum class NormalsMode
{
  exact,  ///< those of all points of a neighborhood
  sparse  ///< those of every fourth row and column: a sixteenth, for speed
};

struct SamplingConfig
{
  int samples = 2000;          ///< number of samples per cloud (n of Algorithm 1)
  std::uint64_t seed = 1;      ///< of all random draws; every cloud starts with it afresh
  bool screen = true;          ///< draw samples first where the surface falls away on both sides, evenly over the image
  bool importance = true;      ///< draw samples of later rounds near the shells that earlier rounds found
  double first_share = 0.6;    ///< share of all samples that the first round draws
  double uniform_share = 0.2;  ///< share of the samples of later rounds that are drawn as in the first round
  double spread = 0.01;        ///< m, standard deviation of a sample drawn near a shell from that shell's sample
  double time_budget_ms = 0.0;  ///< ms of wall time per cloud after which no more samples are examined; 0: no limit
};

struct NeighborhoodConfig
{
  NeighborhoodKind kind = NeighborhoodKind::radius;
  double radius = 0.0;  ///< m, of the sphere, for the kind radius; 0: the capture radius
  int k = 500;          ///< number of points, for the kind knn
  int min_points = 10;  ///< fewest points of a neighborhood that is examined
};

struct OcclusionConfig
{
  bool filter = true;
  int max_points_in_front = 100;        ///< most measured points that may lie in front of a neighborhood
  double min_distance_in_front = 0.05;  ///< m, by which they are nearer to the sensor than its closest point
};

struct EstimationConfig
{
  Estimator estimator = Estimator::taubin;
  int curvature_points = 50;     ///< number of points of a neighborhood at which the quadric's curvature is taken
  bool reject_concave = true;    ///< reject neighborhoods whose centre of curvature is on the sensor's side
  double normals_radius = 0.03;  ///< m, of the sphere of points to which a surface normal is fitted (Normals variation)
  NormalsMode normals_mode = NormalsMode::exact;
};

struct ShellConfig
{
  double radius_step = 0.001;        ///< m, by which the radius grows while the shell is searched
  double clearance_length = 0.03;    ///< m along the axis; thresholds on numbers of points are for this length
  int gap_points_to_block = 5;       ///< number of points in the gap, over the clearance length, that block it
  int min_points_inside = 40;        ///< fewest points inside, over the clearance length, that are taken for a surface
  bool measure_length = true;        ///< measure the extent along the axis that is occupied inside and clear around
  double min_length = 0.03;          ///< m, shortest measured extent that is accepted
  double max_length = 0.12;          ///< m, longest extent that is measured
  double length_resolution = 0.003;  ///< m, of the measured extent
  double min_fill = 0.65;         ///< share of the inner radius that the surface must reach all along a measured extent
  double depth_error = 0.006;     ///< m of noise at a depth of 1 m, growing with its square, that min_fill allows for
  bool recenter = true;           ///< fit the cylinder again to the points inside a shell, and search again about it
  bool straighten = true;         ///< with several views, where no shell is found: search again about a straighter axis
  bool continue_surfaces = true;  ///< continue surfaces through the shadows between them: there they block a gap
  bool require_observed_gap = true;  ///< reject shells where the sensor saw through too small a share of the gap
  double min_observed_free = 0.25;   ///< least share of the gap that the sensor must have seen through
  double min_coverage = 0.7;  ///< least share of the silhouette that must show surface inside the shell; 0: not judged
  bool scale_with_density = true;  ///< scale thresholds on numbers of points with the density of points at the sample's
                                   ///< range, in the sample's own view, but not below 2
  double reference_spacing = 0.0015;  ///< m between the points of neighboring pixels where they hold as given
};

/// An axis-aligned box that samples are drawn in. Points outside still count for clearance and occlusion. The box is in
/// the cloud's frame, or in another that the caller relates to it (see Localizer). The default box limits nothing.
struct WorkspaceConfig
{
  static constexpr double kNoLimit = 100.0;  ///< m; a side of the box that is no nearer to 0 limits nothing

  double min_x = -kNoLimit, max_x = kNoLimit;  ///< m
  double min_y = -kNoLimit, max_y = kNoLimit;  ///< m
  double min_z = -kNoLimit, max_z = kNoLimit;  ///< m

  /// Whether a lower, or an upper, side (m) of the box limits anything.
  static constexpr bool isLowerLimit(double min) { return min > -kNoLimit; }
  static constexpr bool isUpperLimit(double max) { return max < kNoLimit; }

  /// Whether any side of the box limits anything.
  constexpr bool isLimit() const
  {
    return isLowerLimit(min_x) || isUpperLimit(max_x) || isLowerLimit(min_y) || isUpperLimit(max_y) ||
           isLowerLimit(min_z) || isUpperLimit(max_z);
  }
};

/// How shells become handles. A handle is what a hand can close around as one thing, straight or bent.
struct HandlesConfig
{
  double max_angle = 0.6;                ///< rad, between the axes of shells that follow one another along a handle
  double max_distance = 0.005;           ///< m, between the axes of shells that follow one another
  double max_radius_difference = 0.012;  ///< m, between the inner radii of shells that follow one another
  double max_gap = 0.02;                 ///< m, between the ends of shells on either side of a step of the radius
  int min_support = 3;                   ///< fewest shells that make a handle
  double min_score = 0.66;               ///< lowest score of a handle that is reported
};

/// Poses of a hand on the ring around a handle's axis.
struct HandPosesConfig
{
  int count = 12;                   ///< number of directions of approach that are tried on each ring; 0: no hand poses
  double approach_distance = 0.08;  ///< m, by which the hand moves forward to where it closes
  double min_observed_free = 0.5;   ///< least share of the approach corridor that the sensor must have seen through
  double approach_x = 0.0;          ///< preferred direction of approach; all zero: any
  double approach_y = 0.0;          ///< in the approach's frame: the cloud's, or another that the caller relates to it
  double approach_z = 0.0;
  double max_approach_angle = 0.8;  ///< rad, between the preferred direction and a hand's approach
  double tool_x = 0.0;              ///< m, of the tool's frame in the hand's: what hand poses are given for
  double tool_y = 0.0;              ///< m
  double tool_z = 0.0;              ///< m
  double tool_roll = 0.0;           ///< rad, about the hand's x, then its y, then its z (fixed axes)
  double tool_pitch = 0.0;          ///< rad
  double tool_yaw = 0.0;            ///< rad
};

/// How handles keep their identity from cloud to cloud.
struct TrackingConfig
{
  bool track = true;            ///< handles keep their id from cloud to cloud, and are smoothed
  double max_distance = 0.03;   ///< m, at right angles to the axis, by which a handle may move between clouds
  double max_angle = 0.6;       ///< rad, by which a handle may turn between clouds
  double smoothing_time = 1.0;  ///< s, over which a handle's pose and sizes are averaged; 0: not smoothed
  int min_hits = 2;             ///< number of clouds in which a new handle must be found before it is reported
  double lifetime = 1.0;        ///< s, for which a handle that is not found any more is still reported
};

/// Everything that determines a result. The initialisers above are the `localizer` preset, and the only place where its
/// defaults stand. A test compares `config/localizer.yaml` with them.
struct Config
{
  std::string preset = "localizer";  ///< name of the preset that the values started from
  HandGeometry hand;
  SamplingConfig sampling;
  WorkspaceConfig workspace;
  NeighborhoodConfig neighborhood;
  OcclusionConfig occlusion;
  EstimationConfig estimation;
  ShellConfig shell;
  HandlesConfig handles;
  HandPosesConfig hand_poses;
  TrackingConfig tracking;
  int threads = 0;  ///< number of threads that work on a cloud; 0: one per core; no influence on the result
};

/// A parameter with an unknown name, an unreadable value or a value outside its range. what() names all three.
class ParameterError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Names of the presets: "localizer" (the default) and "paper" (Algorithm 1 as printed).
const std::vector<std::string>& presetNames();

/// @throw ParameterError for a name that is not in presetNames().
Config presetConfig(const std::string& name);

/// @throw ParameterError for the first value outside its range.
void validate(const Config& config);

}  // namespace grasp_affordances
