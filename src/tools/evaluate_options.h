#pragma once

#include "evaluation/evaluation.h"
#include "tools/evaluate_suite.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What the command line of `evaluate` asks for.
struct EvaluateOptions
{
  std::vector<EvaluationFrame> frames;   ///< rendered, not recorded
  std::vector<std::string> labels;       ///< files of the recorded clouds
  std::optional<double> capture_radius;  ///< m, where it was given: for the recorded clouds, too
  std::vector<Variation> variations;     ///< validated
  std::size_t runs = 1;
  std::size_t threads = 0;  ///< 0: one per core
  std::string out;          ///< folder
  std::size_t pictures = 0;
  bool runtime = false;
  std::optional<SuiteOptions> suite;  ///< in place of all of that
};

/// @return empty where help or the version was asked for; it has been printed.
/// @throw std::exception for a command line that makes no sense or a parameter that the config refuses. Its what() is
/// one line.
std::optional<EvaluateOptions> parseEvaluateOptions(int argc, const char* const* argv);

}  // namespace grasp_affordances
