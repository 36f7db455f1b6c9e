#include "nodelets/messages/region_of_interest.h"

#include <algorithm>
#include <array>

namespace grasp_affordances
{

bool hasRegion(const RegionOfInterest& region)
{
  const std::array<double, 6> all{region.min.x, region.min.y, region.min.z, region.max.x, region.max.y, region.max.z};
  return std::any_of(all.begin(), all.end(), [](double value) { return value != 0.0; });
}

Config withRegion(Config config, const RegionOfInterest& region)
{
  if (!hasRegion(region)) {
    return config;
  }
  config.workspace.min_x = region.min.x;
  config.workspace.max_x = region.max.x;
  config.workspace.min_y = region.min.y;
  config.workspace.max_y = region.max.y;
  config.workspace.min_z = region.min.z;
  config.workspace.max_z = region.max.z;
  try {
    validate(config);
  } catch (const ParameterError& error) {
    throw ParameterError(std::string("the region is refused as ") + error.what());
  }
  return config;
}

std::string regionFrame(const RegionOfInterest& region, const std::string& workspace_frame)
{
  return hasRegion(region) ? region.frame_id : workspace_frame;
}

}  // namespace grasp_affordances
