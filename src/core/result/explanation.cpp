#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

namespace grasp_affordances
{
namespace
{

std::uint32_t count(const Localization& localization, Outcome outcome)
{
  return localization.counts[static_cast<std::size_t>(outcome)];
}

/// Where most of the samples ended that gave no shell.
Outcome dominating(const std::array<std::uint32_t, kOutcomes>& counts)
{
  static_assert(static_cast<std::size_t>(Outcome::shell) + 1 == kOutcomes, "the shells come last");
  return static_cast<Outcome>(std::max_element(counts.begin(), counts.end() - 1) - counts.begin());
}

/// Before a table most samples end on something flat, whatever stands on it. What became of the others tells more,
/// unless they are too few.
/// @param flat  how many samples are not looked at for that, out
Outcome telling(const Localization& localization, std::uint32_t& flat)
{
  constexpr std::uint32_t kPerCent = 100;
  flat = 0;
  const Outcome most = dominating(localization.counts);
  if (most != Outcome::low_curvature) {
    return most;
  }
  auto others = localization.counts;
  for (const Outcome outcome : {Outcome::low_curvature, Outcome::degenerate}) {
    others[static_cast<std::size_t>(outcome)] = 0;
  }
  const Outcome next = dominating(others);
  if (kPerCent * count(localization, next) <= localization.sampled || next == most) {
    return most;
  }
  flat = count(localization, Outcome::low_curvature) + count(localization, Outcome::degenerate);
  return next;
}

std::string millimetres(double metres)
{
  std::ostringstream text;
  text << metres * 1e3 << " mm";
  return text.str();
}

/// Why no sample was drawn, and where to look.
std::string whyNothingSampled(NothingSampled reason)
{
  const std::string description = describe(reason);
  switch (reason) {
    case NothingSampled::no_cloud:
      break;
    case NothingSampled::empty_cloud:
    case NothingSampled::nothing_measured:
    case NothingSampled::points_coincide:
      return description + ": check the sensor, its distance, and what publishes its cloud";
    case NothingSampled::outside_workspace:
      return description +
             ": widen the box (workspace/min_x to workspace/max_z, or the region of a call), or check its frame";
  }
  return description;
}

std::string shellsWithoutHandle(const Localization& localization, const Config& config)
{
  std::ostringstream text;
  text << localization.shells.size() << (localization.shells.size() == 1 ? " shell was" : " shells were")
       << " found, but no handle with handles/min_support = " << config.handles.min_support
       << " shells about one axis and a score of handles/min_score = " << config.handles.min_score
       << " or more: raise sampling/samples (" << config.sampling.samples << "), or lower one of these thresholds";
  return text.str();
}

/// What it means that samples ended there, and which parameter to change.
std::string meaning(Outcome outcome, const Config& config)
{
  const std::string capture_radius = millimetres(config.hand.capture_radius);
  std::ostringstream text;
  switch (outcome) {
    case Outcome::too_few_points:
      text << "with fewer neighbors than neighborhood/min_points = " << config.neighborhood.min_points
           << ": the cloud is too sparse for this hand; a larger neighborhood/radius includes more points";
      break;
    case Outcome::degenerate:
      text << "on exactly flat, straight or coincident points: add noise to a synthetic cloud; measured ones have it";
      break;
    case Outcome::occluded:
      text << "behind something nearer: move the camera, or raise occlusion/max_points_in_front ("
           << config.occlusion.max_points_in_front << ")";
      break;
    case Outcome::low_curvature:
      text << "on surfaces flatter than the hand's capture radius of " << capture_radius
           << ": larger objects need a larger hand/capture_radius";
      break;
    case Outcome::concave:
      text << "on hollow surfaces, such as the inside of a cup: move the camera to where surfaces bulge towards it, "
              "correct the sensor's place where it was given, or switch estimation/reject_concave off";
      break;
    case Outcome::no_shell:
      text << "where no radius up to the hand's capture radius of " << capture_radius << " has a clear gap of "
           << millimetres(config.hand.finger_thickness)
           << ": things are too large for hand/capture_radius or too close for hand/finger_thickness";
      break;
    case Outcome::too_short:
      text << "with a clear gap over less than " << millimetres(config.shell.min_length)
           << " along the axis: shorter handles need a smaller shell/min_length";
      break;
    case Outcome::unobserved_gap:
      text << "where the sensor saw through less than " << config.shell.min_observed_free
           << " of the gap: move the camera to another side, or lower shell/min_observed_free";
      break;
    case Outcome::uncovered:
      text << "where surface shows in less than " << config.shell.min_coverage
           << " of the silhouette, as along edges: lower shell/min_coverage to find narrow strips and rims";
      break;
    case Outcome::out_of_time:
      text << "before they were examined: raise sampling/time_budget_ms (" << config.sampling.time_budget_ms
           << " ms) or draw fewer sampling/samples";
      break;
    case Outcome::shell:
      break;
  }
  return text.str();
}

std::string whereSamplesEnded(const Localization& localization, const Config& config)
{
  std::uint32_t flat = 0;
  const Outcome outcome = telling(localization, flat);
  std::ostringstream text;
  text << "of " << localization.sampled << " samples " << count(localization, outcome) << " ended "
       << meaning(outcome, config) << " (" << outcomeName(outcome) << ")";
  if (flat > 0) {
    text << "; " << flat << " others are on flat surfaces, as those of tables and walls";
  }
  return text.str();
}

/// How many points the largest object that the hand can close around shows, on the side of the sensor, over the
/// clearance length. Infinite where thresholds on numbers of points follow the density of points.
double mostPointsInside(const Localization& localization, const Config& config)
{
  const double spacing = localization.point_spacing;
  return spacing > 0.0 ? M_PI * config.hand.capture_radius * config.shell.clearance_length / (spacing * spacing)
                       : std::numeric_limits<double>::infinity();
}

std::string sparseness(const Localization& localization, const Config& config)
{
  constexpr double kRounded = 1e-4;  // m
  std::ostringstream text;
  text << "the cloud is too sparse for this hand: neighboring points are some "
       << millimetres(kRounded * std::round(localization.point_spacing / kRounded))
       << " apart, so that over shell/clearance_length = " << millimetres(config.shell.clearance_length)
       << " even an object of the capture radius of " << millimetres(config.hand.capture_radius)
       << " shows fewer points than shell/min_points_inside = " << config.shell.min_points_inside
       << ": use the cloud as it was before it was thinned out, for instance by a voxel grid, or lower that number";
  return text.str();
}

}  // namespace

std::string explainNothing(const Localization& localization, const Config& config)
{
  if (!localization.handles.empty()) {
    return "";
  }
  std::string reason;
  const bool late = 2 * count(localization, Outcome::out_of_time) > localization.sampled;
  if (localization.sampled == 0) {
    reason = whyNothingSampled(localization.nothing_sampled);
  } else if (!localization.shells.empty() && !late) {
    reason = shellsWithoutHandle(localization, config);
  } else if (!late && mostPointsInside(localization, config) < config.shell.min_points_inside) {
    reason = sparseness(localization, config);
  } else {
    reason = whereSamplesEnded(localization, config);
  }
  return "No handle: " + reason + ".";
}

}  // namespace grasp_affordances
