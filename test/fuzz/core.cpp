#include "core/kernels/instruction_sets.h"
#include "fuzz/core_input.h"
#include "fuzz/targets.h"
#include "grasp_affordances/localizer.h"
#include "support/same_bits.h"

#include <cmath>
#include <numeric>

namespace grasp_affordances::fuzz
{
namespace
{

constexpr double kUnit = 1e-6;  // by which the length of a direction may be off 1

bool isShare(double value)
{
  return value >= 0.0 && value <= 1.0;
}

bool isLength(double value)
{
  return std::isfinite(value) && value >= 0.0;
}

/// What is surely known of each cloud.
struct Known
{
  bool image;   // it is a range image
  bool sensor;  // the place of its sensor
};

void requireAxes(const Eigen::Vector3d& axis, const Eigen::Vector3d& normal, const Known& known)
{
  require(std::abs(axis.norm() - 1.0) < kUnit, "an axis is of unit length");
  if (!known.sensor && normal.array().isNaN().all()) {
    return;
  }
  require(std::abs(normal.norm() - 1.0) < kUnit, "a normal is of unit length");
  require(std::abs(axis.dot(normal)) < kUnit, "a normal is at right angles to the axis");
}

void requireSound(const Shell& shell, const Config& config, const Known& known, std::size_t points)
{
  require(shell.centroid.allFinite(), "a shell has a place");
  requireAxes(shell.axis, shell.normal, known);
  require(isLength(shell.inner_radius) && shell.inner_radius <= config.hand.capture_radius + kUnit,
          "a shell fits into the hand");
  require(shell.thickness == config.hand.finger_thickness, "a shell is as thick as a finger");
  require(isLength(shell.length), "a shell has a length");
  require(std::isfinite(shell.curvature) || config.estimation.estimator != Estimator::taubin, "curvature is a number");
  require(isShare(shell.observed_free) || !known.image, "the observed share of the gap is a share");
  require(shell.point_index < points, "a shell's sample is a point of the clouds");
}

void requireSound(const GraspHandle& handle, const Known& known, std::size_t shells)
{
  require(handle.centroid.allFinite(), "a handle has a place");
  requireAxes(handle.axis, handle.normal, known);
  require(isLength(handle.radius) && isLength(handle.inner_radius) && isLength(handle.length), "a handle has a size");
  require(handle.polyline.size() >= 2, "a handle's axis has two ends");
  for (const Eigen::Vector3d& point : handle.polyline) {
    require(point.allFinite(), "a handle's axis has places");
  }
  require(isShare(handle.score) && isShare(handle.agreement) && isShare(handle.clearance), "scores are shares");
  require(isShare(handle.observed_free) || !known.image, "the observed share of the gaps is a share");
  require(!handle.shells.empty() && handle.shells.back() < shells, "a handle is of shells");
  for (const GraspPose& hand : handle.hand_poses) {
    require(hand.pose.matrix().allFinite(), "a hand has a pose");
    require(std::abs(hand.pose.linear().determinant() - 1.0) < kUnit, "a hand's pose is a rotation");
    require(isLength(hand.width) && isShare(hand.score), "a hand has a width and a score");
    require(isShare(hand.observed_free) || !known.image, "the observed share of a corridor is a share");
  }
}

void requireSound(const StageTimes& times)
{
  for (const double milliseconds : {times.total, times.preparation, times.neighborhoods, times.occlusion, times.fit,
                                    times.shell, times.handles, times.hand_poses}) {
    require(isLength(milliseconds), "a time is a number");
  }
}

void requireSound(const Localization& result, const CoreInput& input)
{
  std::size_t points = 0, measured = 0;
  bool may_have_image = false, sensors_known = true;
  for (const Cloud& cloud : input.clouds) {
    points += cloud.size();
    may_have_image = may_have_image || cloud.organized();
    sensors_known = sensors_known && cloud.sensor_origin.has_value();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      measured += cloud.measured(i) ? 1 : 0;
    }
  }
  const bool has_image = may_have_image && result.warnings.empty();
  const Known known{has_image, has_image || sensors_known};
  require(result.points <= measured, "no more points are counted than are measured");
  require(std::accumulate(result.counts.begin(), result.counts.end(), 0U) == result.sampled, "counts add up");
  require(result.sampled <= static_cast<std::uint32_t>(input.config.sampling.samples),
          "no more samples than asked for");
  require(result.counts[static_cast<std::size_t>(Outcome::shell)] == result.shells.size(), "shells are counted");
  for (const Shell& shell : result.shells) {
    requireSound(shell, input.config, known, points);
  }
  for (const GraspHandle& handle : result.handles) {
    requireSound(handle, known, result.shells.size());
  }
  require(std::isnan(result.view_disagreement) || isLength(result.view_disagreement), "views disagree by a length");
  requireSound(result.milliseconds);
  for (const std::string& warning : result.warnings) {
    requireOneLine(warning);
  }
  const std::string explanation = explainNothing(result, input.config);
  require(explanation.empty() == !result.handles.empty(), "nothing found is explained");
}

std::vector<PosedCloud> posedClouds(const CoreInput& input)
{
  std::vector<PosedCloud> posed;
  for (std::size_t i = 0; i < input.clouds.size(); ++i) {
    posed.push_back({&input.clouds[i], input.poses[i]});
  }
  return posed;
}

bool sameBits(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return test::sameBits(a.x(), b.x()) && test::sameBits(a.y(), b.y()) && test::sameBits(a.z(), b.z());
}

void requireSame(const Localization& a, const Localization& b)
{
  require(a.counts == b.counts && a.shells.size() == b.shells.size() && a.handles.size() == b.handles.size() &&
              a.warnings == b.warnings,
          "a result depends on its input alone");
  for (std::size_t i = 0; i < a.shells.size(); ++i) {
    const Shell &one = a.shells[i], &other = b.shells[i];
    require(sameBits(one.centroid, other.centroid) && sameBits(one.axis, other.axis) && one.length == other.length &&
                one.inner_radius == other.inner_radius,
            "a shell depends on its input alone");
  }
}

}  // namespace

void fuzzCore(const std::uint8_t* data, std::size_t size)
{
  static Localizer used;  // its memory is that of inputs before
  ByteReader bytes(data, size);
  const CoreInput input = decodeCoreInput(bytes);
  const std::vector<PosedCloud> posed = posedClouds(input);
  Localization result;
  used.configure(input.config);
  used.localize(posed, result);
  requireSound(result, input);
  if (input.again) {
    static const std::string scalar = instructionSets().back();
    Localization anew;
    useInstructionSet(scalar);
    Localizer(input.config).localize(posed, anew);
    useInstructionSet("");
    requireSame(result, anew);
  }
}

}  // namespace grasp_affordances::fuzz
