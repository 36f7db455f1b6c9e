#pragma once

#include <vector>

namespace grasp_affordances
{

/// A file of config/suites.
struct SuiteFile
{
  const char* name;  ///< without .yaml
  const char* text;
};

const std::vector<SuiteFile>& suiteFiles();

}  // namespace grasp_affordances
