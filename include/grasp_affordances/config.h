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
  double capture_radius = 0.026;    ///< m, radius of the largest circle inscribed in the capture region
  double finger_thickness = 0.008;  ///< m, of the thickest finger or thumb in the opposition plane
  double palm_width = 0.03;         ///< m, of palm and fingers along the opposition axis, which is the shell's
  double palm_depth = 0.06;         ///< m, from the palm's face back: what follows the palm along its approach
};

/// Which points around a sample make up its neighborhood.
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
  int samples = 2000;           ///< neighborhoods drawn per cloud (n of Algorithm 1)
  std::uint64_t seed = 1;       ///< every cloud is seeded with it afresh
  bool screen = true;           ///< sample first where the cloud falls away on both sides, evenly over the image
  bool importance = true;       ///< draw samples of later rounds near the shells that earlier ones found
  double first_share = 0.6;     ///< of the samples, those of the first round
  double uniform_share = 0.2;   ///< of the samples of later rounds, those that are drawn like the first ones
  double spread = 0.01;         ///< m, standard deviation of a sample near a shell from that shell's sample
  double time_budget_ms = 0.0;  ///< ms of wall time after which no more samples are examined; 0: no limit
};

struct NeighborhoodConfig
{
  NeighborhoodKind kind = NeighborhoodKind::radius;
  double radius = 0.0;  ///< m, of the sphere; 0: the capture radius
  int k = 500;          ///< size of a k nearest neighborhood
  int min_points = 10;  ///< a neighborhood with fewer cannot determine a quadric
};

struct OcclusionConfig
{
  bool filter = true;
  int max_points_in_front = 100;        ///< more measured points than this in front of a neighborhood reject it
  double min_distance_in_front = 0.05;  ///< m, by which such a point is nearer than the neighborhood's closest point
};

struct EstimationConfig
{
  Estimator estimator = Estimator::taubin;
  int curvature_points = 50;     ///< points of the neighborhood at which the quadric's curvature is taken
  bool reject_concave = true;    ///< reject neighborhoods whose centre of curvature is on the sensor's side
  double normals_radius = 0.03;  ///< m, support of the surface normals of the Normals variation
  NormalsMode normals_mode = NormalsMode::exact;
};

struct ShellConfig
{
  double radius_step = 0.001;        ///< m, by which the shell grows
  double clearance_length = 0.03;    ///< m along the axis that must be clear
  int gap_points_to_block = 5;       ///< this many points in the gap over the clearance length block it
  int min_points_inside = 40;        ///< fewer points inside the shell are no surface
  bool measure_length = true;        ///< measure the extent along the axis that is occupied inside and clear around
  double min_length = 0.03;          ///< m, shortest measured extent that is accepted
  double max_length = 0.12;          ///< m, extent beyond which nothing is measured
  double length_resolution = 0.003;  ///< m, of the measured extent
  double min_fill = 0.65;            ///< share of the inner radius that the surface reaches all along a measured extent
  double depth_error = 0.006;        ///< m at a depth of 1 m, growing with its square: by so much it may fall short
  bool recenter = true;              ///< fit the cylinder anew to the points inside a shell, and search again
  bool straighten = true;         ///< with several views, where there is no shell: search again about a straighter axis
  bool continue_surfaces = true;  ///< surfaces seen on both sides of a shadow go on through it, and block a gap there
  bool require_observed_gap = true;  ///< require that the sensor saw through a share of the gap
  double min_observed_free = 0.25;   ///< that share
  double min_coverage = 0.7;         ///< share of the silhouette that shows surface inside the shell; 0: not judged
  bool scale_with_density = true;  ///< thresholds that count points follow the density of points at the sample's range,
                                   ///< in its own view, and are at least 2
  double reference_spacing =
      0.0015;  ///< m between neighboring pixels at the range where those thresholds hold as given
};

/// An axis-aligned box that samples are drawn in; what lies outside still counts for clearance and occlusion. Its
/// frame is that of the cloud, or another that the caller relates to it (see Localizer). The default box limits
/// nothing.
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

/// How shells become handles: what a hand can close around as one, straight or bent.
struct HandlesConfig
{
  double max_angle = 0.6;                ///< rad, between the axes of shells that follow one another along a handle
  double max_distance = 0.005;           ///< m, between their axes
  double max_radius_difference = 0.012;  ///< m, between their inner radii
  double max_gap = 0.02;                 ///< m, between the ends of shells on either side of a step of the radius
  int min_support = 3;                   ///< shells; fewer are no handle
  double min_score = 0.66;               ///< handles with a lower score are left out
};

/// Poses of a hand on the ring around a handle's axis.
struct HandPosesConfig
{
  int count = 12;                   ///< directions of approach that are tried on each ring; 0: no hand poses
  double approach_distance = 0.08;  ///< m, by which the hand moves forward to where it closes
  double min_observed_free = 0.5;   ///< share of the approach corridor that the sensor saw through
  double approach_x = 0.0;          ///< direction in which a hand should approach; all zero: any
  double approach_y = 0.0;          ///< in the approach's frame: the cloud's, or another that the caller relates to it
  double approach_z = 0.0;
  double max_approach_angle = 0.8;  ///< rad, between that direction and a hand's approach
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
  double max_distance = 0.03;   ///< m, at right angles to the axis, that a handle may move between clouds
  double max_angle = 0.6;       ///< rad that a handle may turn between clouds
  double smoothing_time = 1.0;  ///< s over which a handle's pose and sizes are averaged; 0: not smoothed
  int min_hits = 2;             ///< clouds that a new handle must be found in before it is reported
  double lifetime = 1.0;        ///< s for which a handle that is not found any more is still reported
};

/// Everything that determines a result. The initialisers above are the `localizer` preset and the only place where its
/// defaults stand; `config/localizer.yaml` is checked against them by a test.
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
  int threads = 0;  ///< that work on a cloud; 0: one per core; no influence on the result
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
