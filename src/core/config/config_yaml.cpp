#include "core/config/yaml_values.h"
#include "grasp_affordances/parameters.h"

#include <string>

namespace grasp_affordances
{
namespace
{

Config readConfig(const std::string& text, const Config& base)
{
  YamlValues values(text);
  Config config = base;
  if (values.gives("preset")) {
    std::string preset;
    values("preset", preset, "name of a preset");
    config = presetConfig(preset);
  }
  visitParameters(config, values);
  values.refuseRemaining();
  validate(config);
  return config;
}

}  // namespace

Config configFromYaml(const std::string& text, const Config& base)
{
  return withOneLineErrors([&] { return readConfig(text, base); });
}

Config configFromYamlFile(const std::string& path, const Config& base)
{
  return parsedFile(path, [&](const std::string& text) { return configFromYaml(text, base); });
}

}  // namespace grasp_affordances
