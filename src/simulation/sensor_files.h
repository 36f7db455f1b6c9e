#pragma once

#include <vector>

namespace grasp_affordances
{

/// A file of config/sensors.
struct SensorFile
{
  const char* name;  ///< without .yaml
  const char* text;
};

const std::vector<SensorFile>& sensorFiles();

}  // namespace grasp_affordances
