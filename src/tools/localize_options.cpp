#include "tools/localize_options.h"

#include "grasp_affordances/parameters.h"
#include "io/pcd.h"

#include <yaml-cpp/yaml.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <locale>
#include <map>
#include <sstream>

namespace grasp_affordances
{
namespace
{

/// An option that sets one of the config's parameters.
struct ParameterOption
{
  const char* name;
  const char* type;
  const char* parameter;
  const char* description;
};

constexpr ParameterOption kParameterOptions[] = {
    {"--samples", "N", "sampling/samples", "neighborhoods drawn per cloud"},
    {"--capture-radius", "R", "hand/capture_radius", "of the hand, m"},
    {"--finger-thickness", "T", "hand/finger_thickness", "gap that must be clear, m"},
    {"--min-length", "L", "shell/min_length", "shortest affordance along its axis, m; has it measured in any preset"},
    {"--neighborhood", "KIND", "neighborhood/kind", "radius or knn"},
    {"--estimator", "NAME", "estimation/estimator", "taubin, pca or normals"},
    {"--threads", "N", "threads", "that work on a cloud; 0: one per core"},
    {"--seed", "S", "sampling/seed", "of the random draws, the same for every cloud"},
};

/// The options that set parameters, as given.
class ParameterValues
{
public:
  explicit ParameterValues(CLI::App& app) : app_(app)
  {
    for (const ParameterOption& option : kParameterOptions) {
      app.add_option(option.name, values_[option.name], option.description)->type_name(option.type);
    }
  }

  std::string yaml() const
  {
    YAML::Node root(YAML::NodeType::Map);
    for (const ParameterOption& option : kParameterOptions) {
      if (app_.count(option.name) == 0) {
        continue;
      }
      const std::string path = option.parameter;
      const std::size_t slash = path.find('/');
      if (slash == std::string::npos) {
        root[path] = values_.at(option.name);
      } else {
        root[path.substr(0, slash)][path.substr(slash + 1)] = values_.at(option.name);
      }
    }
    if (app_.count("--min-length") > 0) {
      root["shell"]["measure_length"] = true;
    }
    return YAML::Dump(root);
  }

private:
  const CLI::App& app_;
  std::map<std::string, std::string> values_;
};

Config makeConfig(const std::string& preset, const std::string& file, const ParameterValues& values)
{
  Config config = preset.empty() ? Config() : presetConfig(preset);
  if (!file.empty()) {
    config = configFromYamlFile(file, config);
    if (!preset.empty() && config.preset != preset) {
      throw UsageError("--preset " + preset + " contradicts " + file + ", whose preset is " + config.preset);
    }
  }
  return configFromYaml(values.yaml(), config);
}

/// Numbers with commas between them. Empty for anything else.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> parseNumbers(const std::string& text)
{
  std::array<double, kCount> values{};
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if ((i > 0 && stream.get() != ',') || !(stream >> values[i])) {
      return std::nullopt;
    }
  }
  return stream.peek() == std::istringstream::traits_type::eof() ? std::make_optional(values) : std::nullopt;
}

/// x,y,z,qx,qy,qz,qw. Empty for anything else.
std::optional<SensorPose> parsePose(const std::string& text)
{
  const auto values = parseNumbers<7>(text);
  if (!values) {
    return std::nullopt;
  }
  const auto& [x, y, z, qx, qy, qz, qw] = *values;
  return SensorPose{{x, y, z}, Eigen::Quaterniond(qw, qx, qy, qz)};
}

/// x,y,z.
Eigen::Vector3f parseViewpoint(const std::string& text)
{
  if (const auto values = parseNumbers<3>(text)) {
    const Eigen::Vector3f place = Eigen::Vector3d(values->data()).cast<float>();
    if (place.allFinite()) {
      return place;
    }
  }
  throw UsageError("--viewpoint " + text + ": the place is not three numbers x,y,z");
}

/// FILE.pcd:x,y,z,qx,qy,qz,qw, or a file without a pose, the name of which may hold colons.
ViewFile parseView(const std::string& text)
{
  const std::size_t colon = text.rfind(':');
  const std::string behind = colon == std::string::npos ? "" : text.substr(colon + 1);
  const auto pose = parsePose(behind);
  if (!pose) {
    if (behind.find(',') != std::string::npos) {
      throw UsageError("--view " + text + ": the pose is not seven numbers x,y,z,qx,qy,qz,qw");
    }
    return {text, std::nullopt};
  }
  const auto transform = pose->transform();
  if (!transform) {
    throw UsageError("--view " + text + ": the quaternion qx,qy,qz,qw is not of unit length");
  }
  return {text.substr(0, colon), transform};
}

std::string firstLine(const std::string& text)
{
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::optional<LocalizeOptions> parseLocalizeOptions(int argc, const char* const* argv)
{
  CLI::App app(
      "Localizes enveloping grasp affordances in point clouds: PCD files, and bags with sensor_msgs/PointCloud2.",
      "localize");
  app.footer("Exit status: 0 done, 1 an input was unreadable or malformed, 2 usage, bad parameter or config.");
  LocalizeOptions options;
  std::string preset, config_file, viewpoint;
  std::vector<std::string> views;
  bool version = false;
  app.add_option("clouds", options.inputs, "PCD files and bags; their first bytes say which")
      ->type_name("CLOUD.pcd|BAG.bag");
  app.add_option("--view", views,
                 "one of several clouds of one scene, localized in together: with the pose of its frame in the common "
                 "one, metres and a unit quaternion, or with that of its VIEWPOINT (which has qw first). Results are "
                 "in the common frame")
      ->type_name("FILE.pcd[:x,y,z,qx,qy,qz,qw]")
      ->allow_extra_args(false);
  app.add_option("--viewpoint", viewpoint,
                 "place of the sensor in the cloud's frame, m, in place of a file's VIEWPOINT; not used for a range "
                 "image, whose sensor is at the origin")
      ->type_name("X,Y,Z");
  app.add_option("--config", config_file, "YAML file of parameters, read over the preset")->type_name("FILE");
  app.add_option("--preset", preset, "localizer (default) or paper")->type_name("NAME");
  const ParameterValues values(app);
  app.add_option("--topic", options.topic, "of the bags' clouds; not needed where there is one only")->type_name("T");
  app.add_option("--picture", options.picture,
                 "draw cloud and shells; the second cloud and those after it go to FILE-2.png, FILE-3.png, ...")
      ->type_name("FILE.png");
  app.add_flag("--json", options.json, "one line of JSON per cloud on stdout");
  app.add_flag("--version", version, "print the version");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return std::nullopt;
    }
    throw UsageError(firstLine(error.what()) + " (--help lists the options)");
  }
  if (version) {
    std::cout << "localize " << GRASP_AFFORDANCES_VERSION << "\n";
    return std::nullopt;
  }
  std::transform(views.begin(), views.end(), std::back_inserter(options.views), parseView);
  if (app.count("--viewpoint") > 0) {
    if (!options.views.empty()) {
      throw UsageError("--viewpoint " + viewpoint + ": each --view has a sensor of its own, at the pose in VIEWPOINT");
    }
    options.viewpoint = parseViewpoint(viewpoint);
  }
  if (!options.inputs.empty() && !options.views.empty()) {
    throw UsageError("--view " + views.front() + " and " + options.inputs.front() +
                     ": clouds are given either as views or each for itself");
  }
  if (options.inputs.empty() && options.views.empty()) {
    throw UsageError("no cloud given (--help lists the options)");
  }
  options.config = makeConfig(preset, config_file, values);
  return options;
}

}  // namespace grasp_affordances
