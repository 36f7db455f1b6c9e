#include "grasp_affordances/config.h"

#include "core/config/range_check.h"
#include "grasp_affordances/parameters.h"

#include <cmath>
#include <sstream>

namespace grasp_affordances
{
namespace
{

Config paperConfig()
{
  Config config;
  config.preset = "paper";
  config.sampling.samples = 4000;
  config.sampling.screen = false;
  config.sampling.importance = false;
  config.occlusion.max_points_in_front = 20;
  config.occlusion.min_distance_in_front = 0.0;
  config.estimation.reject_concave = false;
  config.shell.measure_length = false;
  config.shell.recenter = false;
  config.shell.straighten = false;
  config.shell.min_coverage = 0.0;
  config.shell.continue_surfaces = false;
  config.shell.require_observed_gap = false;
  config.shell.scale_with_density = false;
  return config;
}

}  // namespace

const std::vector<std::string>& presetNames()
{
  static const std::vector<std::string> names{"localizer", "paper"};
  return names;
}

Config presetConfig(const std::string& name)
{
  if (name == "localizer") {
    return Config();
  }
  if (name == "paper") {
    return paperConfig();
  }
  throw ParameterError("preset: '" + name + "' is none of: " + listed(presetNames()));
}

namespace
{

void checkInterval(const std::string& axis, double min, double max)
{
  if (!(min < max)) {
    std::ostringstream message;
    message << "workspace/max_" << axis << ": " << max << " is not above workspace/min_" << axis << ", " << min << " m";
    throw ParameterError(message.str());
  }
}

void checkDirection(const HandPosesConfig& config)
{
  const double length = std::hypot(config.approach_x, config.approach_y, config.approach_z);
  constexpr double kShortest = 0.01;
  if (length > 0.0 && length < kShortest) {
    std::ostringstream message;
    message << "hand_poses/approach_x: (" << config.approach_x << ", " << config.approach_y << ", " << config.approach_z
            << ") with hand_poses/approach_y and hand_poses/approach_z is too short for a "
            << "direction: its length must be 0, for any, or at least " << kShortest;
    throw ParameterError(message.str());
  }
}

}  // namespace

void validate(const Config& config)
{
  visitParameters(config, RangeCheck());
  checkDirection(config.hand_poses);
  checkInterval("x", config.workspace.min_x, config.workspace.max_x);
  checkInterval("y", config.workspace.min_y, config.workspace.max_y);
  checkInterval("z", config.workspace.min_z, config.workspace.max_z);
  const double steps = config.hand.capture_radius / config.shell.radius_step;
  const double slices = config.shell.measure_length ? config.shell.max_length / config.shell.length_resolution : 1.0;
  constexpr double kMostCells = 1e6;  // radii times slices for which a shell search counts points
  if (steps * slices > kMostCells) {
    std::ostringstream message;
    message << "shell/radius_step: " << config.shell.radius_step << " m, with shell/length_resolution "
            << config.shell.length_resolution << " m, is too fine for hand/capture_radius "
            << config.hand.capture_radius << " m and shell/max_length " << config.shell.max_length << " m";
    throw ParameterError(message.str());
  }
  if (config.shell.measure_length && config.shell.max_length < config.shell.min_length) {
    std::ostringstream message;
    message << "shell/max_length: " << config.shell.max_length << " is below shell/min_length, "
            << config.shell.min_length << " m";
    throw ParameterError(message.str());
  }
}

template <>
const std::vector<std::string>& enumWords<NeighborhoodKind>()
{
  static const std::vector<std::string> words{"radius", "knn"};
  return words;
}

template <>
const std::vector<std::string>& enumWords<Estimator>()
{
  static const std::vector<std::string> words{"taubin", "pca", "normals"};
  return words;
}

template <>
const std::vector<std::string>& enumWords<NormalsMode>()
{
  static const std::vector<std::string> words{"exact", "sparse"};
  return words;
}

template <>
NeighborhoodKind enumFromWord<NeighborhoodKind>(const std::string& name, const std::string& word)
{
  return findWord<NeighborhoodKind>(name, word);
}

template <>
Estimator enumFromWord<Estimator>(const std::string& name, const std::string& word)
{
  return findWord<Estimator>(name, word);
}

template <>
NormalsMode enumFromWord<NormalsMode>(const std::string& name, const std::string& word)
{
  return findWord<NormalsMode>(name, word);
}

}  // namespace grasp_affordances
