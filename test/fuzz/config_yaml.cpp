#include "fuzz/targets.h"
#include "grasp_affordances/parameters.h"

namespace grasp_affordances::fuzz
{

void fuzzConfigYaml(const std::uint8_t* data, std::size_t size)
{
  try {
    validate(configFromYaml(std::string(reinterpret_cast<const char*>(data), size), Config()));
  } catch (const ParameterError& error) {
    requireOneLine(error.what());
  }
}

}  // namespace grasp_affordances::fuzz
