#pragma once

#include <vector>

namespace grasp_affordances
{

/// A file of config/ that is compiled in.
struct EmbeddedFile
{
  const char* name;  ///< without .yaml
  const char* text;
};

const std::vector<EmbeddedFile>& sensorFiles();  ///< those of config/sensors
const std::vector<EmbeddedFile>& suiteFiles();   ///< those of config/suites; linked with the evaluation only

}  // namespace grasp_affordances
