#include "evaluation/suite.h"

#include "core/config/one_line.h"
#include "evaluation/recordings.h"
#include "evaluation/seed_list.h"
#include "grasp_affordances/config.h"
#include "simulation/background.h"
#include "simulation/embedded_file.h"
#include "simulation/scene_library.h"
#include "simulation/sensor_model.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace grasp_affordances
{
namespace
{

using Strings = std::vector<std::string>;

/// A list, or a single value as a list of one.
template <class Value>
std::vector<Value> listOf(const YAML::Node& node)
{
  return node.IsSequence() ? node.as<std::vector<Value>>() : std::vector<Value>{node.as<Value>()};
}

void refuseUnknownKeys(const YAML::Node& map, const Strings& known)
{
  if (!map.IsMap()) {
    throw std::invalid_argument("it is no YAML map");
  }
  for (const auto& entry : map) {
    const auto key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw std::invalid_argument("'" + key + "' is no key of a suite");
    }
  }
}

/// Sets what a map gives of a cell, beside row, sensor and background. @return the capture radii (m)
std::vector<double> readCommon(const YAML::Node& map, SuiteCell& cell, std::vector<double> capture_radii)
{
  if (map["seeds"]) {
    cell.seeds = seedList(listOf<std::string>(map["seeds"]));
  }
  if (map["runs"]) {
    cell.runs = map["runs"].as<std::size_t>();
  }
  if (map["pictures"]) {
    cell.pictures = map["pictures"].as<std::size_t>();
  }
  if (map["presets"]) {
    cell.presets = listOf<std::string>(map["presets"]);
  }
  if (map["capture_radii"]) {
    capture_radii = listOf<double>(map["capture_radii"]);
  }
  return capture_radii;
}

/// @throw what the config does for a preset or capture radius that it refuses
void checkConfigs(const SuiteCell& cell)
{
  if (cell.runs == 0) {
    throw std::invalid_argument("runs: at least 1");
  }
  for (const std::string& preset : cell.presets) {
    Config config = presetConfig(preset);
    config.hand.capture_radius = cell.capture_radius;
    validate(config);
  }
}

/// "all", or a list of names or of one.
Strings namesOrAll(const YAML::Node& node, const Strings& all)
{
  const Strings names = listOf<std::string>(node);
  return names == Strings{"all"} ? all : names;
}

/// Rows of an entry with their scenes.
std::vector<std::pair<std::string, Strings>> rowsOf(const YAML::Node& entry)
{
  std::vector<std::pair<std::string, Strings>> rows;
  for (const std::string& family : entry["families"] ? listOf<std::string>(entry["families"]) : Strings{}) {
    rows.push_back({family, {}});
    for (const NamedScene& scene : sceneLibrary()) {
      if (scene.family == family) {
        rows.back().second.push_back(scene.name);
      }
    }
    if (rows.back().second.empty()) {
      throw std::invalid_argument("there is no family of scenes '" + family + "'");
    }
  }
  for (const std::string& scene : entry["scenes"] ? listOf<std::string>(entry["scenes"]) : Strings{}) {
    sceneFamily(scene);  // throws for an unknown one
    rows.push_back({scene, {scene}});
  }
  if (rows.empty()) {
    throw std::invalid_argument("an entry of the grid has neither families nor scenes");
  }
  return rows;
}

class Grid
{
public:
  void add(const YAML::Node& entry, SuiteCell cell, const std::vector<double>& defaults)
  {
    refuseUnknownKeys(entry, {"families", "scenes", "sensors", "backgrounds", "seeds", "runs", "presets",
                              "capture_radii", "pictures"});
    const std::vector<double> capture_radii = readCommon(entry, cell, defaults);
    const Strings sensors = entry["sensors"] ? namesOrAll(entry["sensors"], sensorNames()) : Strings{"xtion"};
    const Strings backgrounds =
        entry["backgrounds"] ? namesOrAll(entry["backgrounds"], backgroundNames()) : Strings{"walls"};
    for (const auto& [row, scenes] : rowsOf(entry)) {
      cell.row = row;
      cell.scenes = scenes;
      for (const double capture_radius : capture_radii) {
        cell.capture_radius = capture_radius;
        checkConfigs(cell);
        for (const std::string& sensor : sensors) {
          sensorModelFromNameOrFile(sensor);  // throws for an unknown one
          cell.sensor = sensor;
          for (const std::string& background : backgrounds) {
            backgroundFromName(background);  // likewise
            cell.background = background;
            addOnce(cell);
          }
        }
      }
    }
  }

  std::vector<SuiteCell> cells;

private:
  void addOnce(const SuiteCell& cell)
  {
    if (known_.insert({cell.row, cell.sensor, cell.background, cell.capture_radius}).second) {
      cells.push_back(cell);
    }
  }

  std::set<std::tuple<std::string, std::string, std::string, double>> known_;
};

std::string textOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!(text << file.rdbuf())) {
    throw std::invalid_argument(path + ": cannot be read");
  }
  return text.str();
}

}  // namespace

std::vector<std::string> suiteNames()
{
  Strings names;
  for (const EmbeddedFile& file : suiteFiles()) {
    names.emplace_back(file.name);
  }
  return names;
}

std::vector<SuiteCell> suiteFromYaml(const std::string& text)
{
  try {
    const YAML::Node root = YAML::Load(text);
    refuseUnknownKeys(root, {"seeds", "runs", "presets", "capture_radii", "pictures", "grid"});
    SuiteCell defaults;
    defaults.seeds = seedList({"101:110"});
    defaults.presets = {"localizer"};
    defaults.pictures = 10;
    const std::vector<double> capture_radii = readCommon(root, defaults, {0.026});
    Grid grid;
    if (!root["grid"] || !root["grid"].IsSequence() || root["grid"].size() == 0) {
      throw std::invalid_argument("there is no list 'grid'");
    }
    for (const YAML::Node& entry : root["grid"]) {
      grid.add(entry, defaults, capture_radii);
    }
    return grid.cells;
  } catch (const std::exception& error) {
    throw std::invalid_argument(oneLine(error.what()));
  }
}

std::vector<SuiteCell> suiteFromNameOrFile(const std::string& name_or_path)
{
  if (std::filesystem::path(name_or_path).extension() == ".yaml") {
    try {
      return suiteFromYaml(textOf(name_or_path));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name_or_path + ": " + error.what());
    }
  }
  std::string names;
  for (const EmbeddedFile& file : suiteFiles()) {
    if (name_or_path == file.name) {
      return suiteFromYaml(file.text);
    }
    names += (names.empty() ? "" : ", ") + std::string(file.name);
  }
  throw std::invalid_argument("there is no suite '" + oneLine(name_or_path) + "'; there are " + names);
}

std::vector<SuiteCell> recordedCells(const std::vector<std::string>& labels_files, const std::string& sensor,
                                     const SuiteCell& like)
{
  std::vector<SuiteCell> cells;
  const Strings sets = recordedSets(labels_files);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SuiteCell cell = like;
    cell.row = sets[i];
    cell.sensor = sensor;
    cell.background = "recorded";
    cell.capture_radius = recordedCaptureRadius(labels_files[i]);
    cell.scenes = {};
    cell.seeds = {};
    cell.labels = labels_files[i];
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace grasp_affordances
