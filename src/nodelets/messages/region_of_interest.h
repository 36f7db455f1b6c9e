#pragma once

#include "grasp_affordances/RegionOfInterest.h"
#include "grasp_affordances/config.h"

#include <string>

namespace grasp_affordances
{

/// Whether a message gives a region, and does not leave it to the parameters.
bool hasRegion(const RegionOfInterest& region);

/// The parameters for a cloud in which this region is asked for: it takes the place of `workspace`.
/// @throw ParameterError for a region without extent, or one beyond the range of `workspace`
Config withRegion(Config config, const RegionOfInterest& region);

/// Frame of the box of withRegion(): the region's, or that of the parameters' box; empty: the cloud's.
std::string regionFrame(const RegionOfInterest& region, const std::string& workspace_frame);

}  // namespace grasp_affordances
