#pragma once

#include "evaluation/statistics.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace grasp_affordances
{

/// Time of Localizer::localize() for one cloud (paper, figure 7).
struct Runtime
{
  Config config;      ///< k nearest neighbors
  Mean milliseconds;  ///< over the repetitions
};

/// Measures each variation with each number of samples and the k of its config, with the config's threads; a first call
/// that warms up is not counted. @param done  called after each measurement
std::vector<Runtime> measureRuntimes(const Cloud& cloud, const std::vector<Config>& variations,
                                     const std::vector<int>& samples, std::size_t repetitions,
                                     const std::function<void()>& done);

}  // namespace grasp_affordances
