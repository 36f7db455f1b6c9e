#pragma once

#include "evaluation/labelled_cloud.h"
#include "evaluation/suite.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The frames of a cell. @throw std::exception for labels that cannot be read
std::vector<EvaluationFrame> framesOf(const SuiteCell& cell);

/// Evaluates a cell with Taubin's estimator, and draws its errors into `pictures`. docs/evaluation.md describes the
/// result. It depends on the cell alone, not on the number of threads.
/// @param config_file  YAML file of parameters, read over each preset; empty: none
/// @param threads  0: one per core
/// @param done  called after each frame, from one thread at a time
/// @throw what loading a frame and drawing throw
nlohmann::json evaluateCell(const SuiteCell& cell, const std::string& config_file, const std::string& pictures,
                            std::size_t threads, const std::function<void()>& done);

/// What a cell is: with the same description, files and code its result is the same.
nlohmann::json cellDescription(const SuiteCell& cell);

}  // namespace grasp_affordances
