#pragma once

#include "evaluation/suite.h"

#include <cstddef>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What `evaluate --suite` asks for.
struct SuiteOptions
{
  std::string name;                 ///< of the suite, or its file
  std::vector<SuiteCell> cells;     ///< at least one
  std::vector<std::string> labels;  ///< files of recorded clouds, each a row
  std::string sensor;               ///< that recorded them
  std::string config_file;          ///< YAML file of parameters, read over each preset; empty: none
  std::size_t threads = 0;          ///< 0: one per core
  std::string out;                  ///< folder
};

/// Evaluates the cells that are not finished yet, one after the other; writes suite.json and table.md, and prints the
/// tables. @throw std::exception for an input that cannot be read or a file that cannot be written
void evaluateSuite(const SuiteOptions& options);

}  // namespace grasp_affordances
