#pragma once

#include "evaluation/suite.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace grasp_affordances
{

/// Results of cells as files in FOLDER/cells, so that a suite goes on where it was interrupted. A result counts as long
/// as nothing that it depends on has changed: the cell, the files that it names, the parameters, the code.
class SuiteStore
{
public:
  /// @param config_file  YAML file of parameters; empty: none
  /// @throw std::exception for a folder that cannot be made or a file that cannot be read
  SuiteStore(std::string folder, const std::string& config_file);

  /// The cell with its results, where it is finished.
  std::optional<nlohmann::json> find(const SuiteCell& cell) const;

  /// Stores results, at once or not at all, and returns the cell with them. @throw std::runtime_error for a file that
  /// cannot be written
  nlohmann::json save(const SuiteCell& cell, const nlohmann::json& results, double seconds) const;

  /// Where the cell's pictures are, below the folder.
  static std::string picturesOf(const SuiteCell& cell);

private:
  std::string path(const SuiteCell& cell) const;
  nlohmann::json keyOf(const SuiteCell& cell) const;

  std::string folder_;
  std::string code_;    // fingerprint of the code
  std::string config_;  // and of the file of parameters
};

}  // namespace grasp_affordances
