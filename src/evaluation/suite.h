#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// One cell of a grid: some scenes, or one set of recorded clouds, of one sensor, for one capture radius.
struct SuiteCell
{
  std::string row;                   ///< title of its row: a family, a scene or a set of recorded clouds
  std::string sensor;                ///< name, or path of a sensor's file
  std::string background;            ///< name; "recorded" for recorded clouds
  double capture_radius = 0.0;       ///< m
  std::vector<std::string> presets;  ///< each localizes in the same frames

  // Of rendered scenes.
  std::vector<std::string> scenes;
  std::vector<std::uint64_t> seeds;

  std::string labels;  ///< of recorded clouds: their file of labels; empty: rendered

  std::size_t runs = 1;      ///< per frame and preset
  std::size_t pictures = 0;  ///< most pictures per scene, preset and kind of error

  bool recorded() const { return !labels.empty(); }
};

/// Names of the known suites: the files of config/suites, which are compiled in.
std::vector<std::string> suiteNames();

/// The cells of a grid, each once, in the order of the grid:
///
///     seeds: [101:110]                  # numbers and ranges; of scenes and noise
///     runs: 1                           # per frame; run r samples with the seed r
///     presets: [localizer, paper]
///     capture_radii: [0.026]            # m
///     pictures: 10                      # at most so many of each kind of error per scene and preset
///     grid:                             # each entry: all its families and scenes with all its sensors and backgrounds
///       - families: [paper]             # a row for each; and, or
///         scenes: [mugs]                # a row for each
///         sensors: [xtion, my.yaml]     # names and files of sensors; or all
///         backgrounds: [open]           # or all
///         capture_radii: [0.045]        # seeds, runs, presets and capture_radii in place of those above
///
/// Seeds, runs, presets, capture radii and pictures have defaults: 101:110, 1, localizer, 0.026 and 10.
/// @throw std::invalid_argument, with one line, for text that is not as above, and for names that are not known
std::vector<SuiteCell> suiteFromYaml(const std::string& text);

/// The known suite of that name or, where the name ends in .yaml, that of a file. @throw as suiteFromYaml(), and for a
/// name that is not known or a file that cannot be read
std::vector<SuiteCell> suiteFromNameOrFile(const std::string& name_or_path);

/// Recorded clouds as cells, one for each file of labels: a row named after its file, for the capture radius of its
/// hand.
/// @param sensor  that recorded them, in any words
/// @param like  with their runs, presets and pictures
/// @throw std::exception for files that cannot be read
std::vector<SuiteCell> recordedCells(const std::vector<std::string>& labels_files, const std::string& sensor,
                                     const SuiteCell& like);

}  // namespace grasp_affordances
