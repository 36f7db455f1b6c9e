#include "core/config/one_line.h"
#include "grasp_affordances/parameters.h"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kMostBytes = 1000000;  // of a file; one with every parameter and its comment has 10000

using Values = std::map<std::string, YAML::Node>;

/// Nested maps become paths: {hand: {capture_radius: r}} is "hand/capture_radius". No parameter lies deeper than that.
void flatten(const YAML::Node& map, const std::string& prefix, Values& values)
{
  for (const auto& entry : map) {
    const auto name = prefix + oneLine(entry.first.as<std::string>());  // errors begin with the name
    if (entry.second.IsMap() && prefix.empty()) {
      flatten(entry.second, name + "/", values);
    } else {
      values[name] = entry.second;
    }
  }
}

std::string textOf(const YAML::Node& node)
{
  std::ostringstream text;
  text << node;
  return text.str();
}

template <typename T>
T valueAs(const std::string& name, const YAML::Node& node, const char* kind)
{
  try {
    if (std::is_unsigned<T>::value && textOf(node).find('-') != std::string::npos) {
      throw YAML::TypedBadConversion<T>(node.Mark());  // yaml-cpp up to 0.6 takes -1 for the largest number
    }
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw ParameterError(name + ": '" + textOf(node) + "' is not " + kind);
  }
}

/// Takes the values that have a parameter out of a map, into the config's fields.
class ValuesToConfig
{
public:
  explicit ValuesToConfig(Values& values) : values_(values) {}

  template <typename T>
  void operator()(const char* name, T& field, const Range<T>&, const char*, const char*)
  {
    const bool real = std::is_floating_point<T>::value;
    take(name, [&](const YAML::Node& node) { field = valueAs<T>(name, node, real ? "a number" : "a whole number"); });
  }

  void operator()(const char* name, bool& field, const char*)
  {
    take(name, [&](const YAML::Node& node) { field = valueAs<bool>(name, node, "true or false"); });
  }

  template <typename Enum>
  void operator()(const char* name, Enum& field, const char*)
  {
    take(name,
         [&](const YAML::Node& node) { field = enumFromWord<Enum>(name, valueAs<std::string>(name, node, "a word")); });
  }

private:
  template <typename Reader>
  void take(const char* name, Reader&& read)
  {
    const auto found = values_.find(name);
    if (found != values_.end()) {
      read(found->second);
      values_.erase(found);
    }
  }

  Values& values_;
};

Config readConfig(const std::string& text, const Config& base)
{
  if (text.size() > kMostBytes) {
    throw ParameterError("the configuration is longer than " + std::to_string(kMostBytes) + " bytes");
  }
  Values values;
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap() && !root.IsNull()) {
      throw ParameterError("the configuration is no YAML map");
    }
    flatten(root, "", values);
  } catch (const YAML::Exception& error) {
    throw ParameterError(std::string("the configuration is no YAML: ") + error.what());
  }

  Config config = base;
  const auto preset = values.find("preset");
  if (preset != values.end()) {
    config = presetConfig(valueAs<std::string>("preset", preset->second, "a word"));
    values.erase(preset);
  }
  visitParameters(config, ValuesToConfig(values));
  if (!values.empty()) {
    const auto& unknown = *values.begin();
    throw ParameterError(unknown.first + ": no such parameter (its value: '" + textOf(unknown.second) + "')");
  }
  validate(config);
  return config;
}

}  // namespace

Config configFromYaml(const std::string& text, const Config& base)
{
  try {
    return readConfig(text, base);
  } catch (const ParameterError& error) {
    throw ParameterError(oneLine(error.what()));
  } catch (const YAML::Exception& error) {  // of a value that cannot even be quoted
    throw ParameterError(oneLine(std::string("the configuration is no YAML: ") + error.what()));
  }
}

Config configFromYamlFile(const std::string& path, const Config& base)
{
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (!file.is_open() || file.bad()) {
    throw ParameterError(path + ": cannot be read");
  }
  try {
    return configFromYaml(text, base);
  } catch (const ParameterError& error) {
    throw ParameterError(path + ": " + error.what());
  }
}

}  // namespace grasp_affordances
