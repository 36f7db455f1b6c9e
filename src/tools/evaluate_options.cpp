#include "tools/evaluate_options.h"

#include "evaluation/seed_list.h"
#include "grasp_affordances/parameters.h"
#include "simulation/background.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor_model.h"
#include "tools/number_range.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

using Strings = std::vector<std::string>;

/// The command line, as given.
struct Arguments
{
  Strings scenes, seeds{"101:120"}, estimators{"taubin", "pca", "normals"}, presets{"paper", "localizer"};
  Strings labels;
  std::optional<std::string> sensor;
  std::string suite, background = "walls", config_file, out = "evaluation";
  std::vector<int> samples;
  Strings importance;
  std::optional<double> capture_radius;
  std::vector<double> turns{0.0};
  std::size_t runs = 1, threads = 0, pictures = 10;
  bool runtime = false;
};

template <class Value>
void requireDistinct(const std::string& option, std::vector<Value> values)
{
  std::sort(values.begin(), values.end());
  if (std::adjacent_find(values.begin(), values.end()) != values.end()) {
    throw std::invalid_argument(option + ": a value is given twice");
  }
}

/// Names of scenes for names of scenes and families; `hard` and `all` stand for several families.
Strings sceneNames(const Strings& words)
{
  const Strings hard{"far", "clutter", "distractors"};
  Strings names;
  for (const std::string& word : words) {
    const std::size_t before = names.size();
    for (const NamedScene& scene : sceneLibrary()) {
      const bool is_hard = std::find(hard.begin(), hard.end(), scene.family) != hard.end();
      const bool of_several =
          (is_hard && (word == "hard" || word == "all")) || (scene.family == "paper" && word == "all");
      if (scene.name == word || scene.family == word || of_several) {
        names.push_back(scene.name);
      }
    }
    if (names.size() == before) {
      throw std::invalid_argument("--scenes: unknown scene '" + word + "' (simulate --list names them)");
    }
  }
  requireDistinct("--scenes", names);
  return names;
}

/// Calls read() and puts the option's name before its errors. @throw std::invalid_argument
template <class Reader>
auto readOption(const std::string& option, const Reader& read)
{
  try {
    return read();
  } catch (const std::exception& error) {
    throw std::invalid_argument(option + ": " + error.what());
  }
}

bool parseSwitch(const std::string& option, const std::string& word)
{
  if (word != "on" && word != "off") {
    throw std::invalid_argument(option + ": '" + word + "' is neither on nor off");
  }
  return word == "on";
}

/// What is asked for in place of the preset's sampling.
std::vector<SamplingConfig> samplings(const Arguments& arguments, SamplingConfig sampling)
{
  const bool preset_importance = sampling.importance;
  std::vector<bool> importances;
  for (const std::string& word : arguments.importance) {
    importances.push_back(parseSwitch("--importance", word));
  }
  std::vector<SamplingConfig> result;
  for (const int samples : arguments.samples.empty() ? std::vector<int>{sampling.samples} : arguments.samples) {
    for (const bool importance : importances.empty() ? std::vector<bool>{preset_importance} : importances) {
      sampling.samples = samples;
      sampling.importance = importance;
      result.push_back(sampling);
    }
  }
  return result;
}

std::vector<Variation> makeVariations(const Arguments& arguments)
{
  std::vector<Variation> variations;
  for (const std::string& preset : arguments.presets) {
    Config config = presetConfig(preset);
    if (!arguments.config_file.empty()) {
      config = configFromYamlFile(arguments.config_file, config);
      if (config.preset != preset) {
        throw std::invalid_argument("--presets " + preset + " contradicts " + arguments.config_file +
                                    ", whose preset is " + config.preset);
      }
    }
    config.hand.capture_radius = arguments.capture_radius.value_or(config.hand.capture_radius);
    for (const std::string& estimator : arguments.estimators) {
      config.estimation.estimator = enumFromWord<Estimator>("--estimators", estimator);
      for (const SamplingConfig& sampling : samplings(arguments, config.sampling)) {
        Config variation = config;
        variation.sampling = sampling;
        validate(variation);
        for (std::size_t views = 1; views <= arguments.turns.size(); ++views) {
          variations.push_back({variation, views});
        }
      }
    }
  }
  return variations;
}

SuiteOptions makeSuite(const Arguments& arguments)
{
  SuiteOptions suite;
  suite.name = arguments.suite;
  suite.cells = readOption("--suite", [&] { return suiteFromNameOrFile(arguments.suite); });
  suite.labels = arguments.labels;
  suite.sensor = arguments.sensor.value_or("unknown");
  suite.config_file = arguments.config_file;
  suite.threads = arguments.threads;
  suite.out = arguments.out;
  return suite;
}

EvaluateOptions makeOptions(const Arguments& arguments)
{
  if (!arguments.suite.empty()) {
    EvaluateOptions options;
    options.suite = makeSuite(arguments);
    return options;
  }
  requireDistinct("--presets", arguments.presets);
  requireDistinct("--estimators", arguments.estimators);
  requireDistinct("--samples", arguments.samples);
  requireDistinct("--importance", arguments.importance);
  requireDistinct("--turn", arguments.turns);
  if (arguments.turns != Arguments().turns && !arguments.labels.empty()) {
    throw std::invalid_argument("--turn: the camera of recorded clouds (--labels) cannot be turned");
  }
  EvaluateOptions options;
  options.variations = makeVariations(arguments);
  const HandGeometry& hand = options.variations.front().config.hand;
  GraspDefinition definition;
  definition.capture_radius = hand.capture_radius;
  definition.clearance = hand.finger_thickness;
  const bool only_recorded = arguments.scenes.empty() && !arguments.labels.empty();
  const Strings scenes = arguments.scenes.empty() ? Strings{"paper"} : arguments.scenes;
  std::vector<double> turns;
  for (const double degrees : arguments.turns) {
    turns.push_back(kDegree * degrees);
  }
  const auto seeds = readOption("--seeds", [&] { return seedList(arguments.seeds); });
  const auto sensor =
      readOption("--sensor", [&] { return sensorModelFromNameOrFile(arguments.sensor.value_or("xtion")); });
  const auto background = readOption("--background", [&] { return backgroundFromName(arguments.background); });
  for (const std::string& scene : only_recorded ? Strings{} : sceneNames(scenes)) {
    const std::string family = sceneFamily(scene) == "tests" ? "" : sceneFamily(scene);
    for (const std::uint64_t seed : seeds) {
      options.frames.push_back(renderedFrame(family, scene, seed, definition, turns, sensor, background));
    }
  }
  options.labels = arguments.labels;
  options.capture_radius = arguments.capture_radius;
  options.runs = arguments.runs;
  options.threads = arguments.threads;
  options.out = arguments.out;
  options.pictures = arguments.pictures;
  options.runtime = arguments.runtime;
  return options;
}

void addOptions(CLI::App& app, Arguments& arguments)
{
  app.add_option("--scenes", arguments.scenes,
                 "of the library, or families; paper: the paper's ten (default without --labels); hard: far, clutter, "
                 "distractors; all: both; doors, tools, supermarket, desk")
      ->type_name("NAME,..")
      ->delimiter(',');
  app.add_option("--seeds", arguments.seeds, "of scenes and noise: numbers and ranges (default 101:120)")
      ->type_name("A:B,..")
      ->delimiter(',');
  app.add_option(
         "--turn", arguments.turns,
         "views of each scene: one for each of so many degrees by which the camera is turned about the vertical; "
         "evaluates with the first view, the first two, and so on (default 0)")
      ->type_name("DEG,..")
      ->delimiter(',')
      ->check(numberRange(-180.0, 180.0));
  app.add_option_function<std::string>(
         "--sensor", [&arguments](const std::string& sensor) { arguments.sensor = sensor; },
         "that renders the scenes: a name of config/sensors or a file of such a kind (default xtion); with --suite: "
         "that recorded the clouds of --labels")
      ->type_name("NAME|FILE.yaml");
  app.add_option("--background", arguments.background,
                 "of rendered scenes: walls, open, far, room or dark (default walls)")
      ->type_name("NAME");
  app.add_option("--labels", arguments.labels, "evaluate recorded clouds, too: JSON files, with the clouds beside them")
      ->type_name("FILE,..")
      ->delimiter(',');
  app.add_option("--runs", arguments.runs, "per frame; run r samples with the seed r (default 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  app.add_option("--presets", arguments.presets, "default paper,localizer")->type_name("NAME,..")->delimiter(',');
  app.add_option("--estimators", arguments.estimators, "default taubin,pca,normals")
      ->type_name("NAME,..")
      ->delimiter(',');
  app.add_option("--config", arguments.config_file, "YAML file of parameters, read over each preset")
      ->type_name("FILE");
  app.add_option("--samples", arguments.samples,
                 "neighborhoods drawn per cloud; of several numbers each is evaluated (default: the preset's)")
      ->type_name("N,..")
      ->delimiter(',');
  app.add_option("--importance", arguments.importance,
                 "importance sampling: on, off or both to compare them (default: the preset's)")
      ->type_name("on,off")
      ->delimiter(',');
  app.add_option_function<double>(
         "--capture-radius", [&arguments](double radius) { arguments.capture_radius = radius; },
         "of the hand, m; also decides what is graspable in rendered scenes")
      ->type_name("R");
  app.add_flag("--runtime", arguments.runtime,
               "measure the running time, too: 1000 to 10000 samples, k nearest neighbors, on a rendered cleaning2");
  app.add_option("--pictures", arguments.pictures,
                 "draw at most N errors of each kind (wrong shells, wrong handles, misses, ...) per scene, preset and "
                 "estimator "
                 "(default 10)")
      ->type_name("N")
      ->check(CLI::Range(0, 100000));
  app.add_option("--suite", arguments.suite,
                 "evaluate a grid of scenes, sensors and backgrounds in place of --scenes, and go on where an earlier "
                 "call ended: quick, short, full or a file of a suite")
      ->type_name("NAME|FILE.yaml");
  app.add_option("--threads", arguments.threads, "frames at a time; 0: one per core; no influence on the result")
      ->type_name("N")
      ->check(CLI::Range(0, 256));
  app.add_option("--out", arguments.out, "folder to write into (default evaluation)")->type_name("DIR");
}

std::string firstLine(const std::string& text)
{
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::optional<EvaluateOptions> parseEvaluateOptions(int argc, const char* const* argv)
{
  CLI::App app(
      "Measures precision, recall and running time on rendered scenes and on recorded clouds with labels, and writes "
      "tables and pictures of the errors.",
      "evaluate");
  app.footer(
      "Exit status: 0 done, 1 an input was unreadable or an output not writable, 2 usage, bad parameter or "
      "config.");
  Arguments arguments;
  bool version = false;
  addOptions(app, arguments);
  for (const char* option : {"--scenes", "--seeds", "--turn", "--runs", "--presets", "--estimators", "--samples",
                             "--importance", "--capture-radius", "--background", "--runtime", "--pictures"}) {
    app.get_option("--suite")->excludes(app.get_option(option));  // the suite's file says what they would
  }
  app.add_flag("--version", version, "print the version");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return std::nullopt;
    }
    throw std::invalid_argument(firstLine(error.what()) + " (--help lists the options)");
  }
  if (version) {
    std::cout << "evaluate " << GRASP_AFFORDANCES_VERSION << "\n";
    return std::nullopt;
  }
  return makeOptions(arguments);
}

}  // namespace grasp_affordances
