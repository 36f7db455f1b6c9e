#pragma once

#include "core/config/one_line.h"
#include "grasp_affordances/parameters.h"

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>

namespace grasp_affordances
{

constexpr std::size_t kMostYamlBytes = 1000000;  // of a file; one with every parameter and its comment has 10000

/// The values of a YAML map by the paths of their parameters, and a visitor for visitParameters() and its like: it
/// takes the values that have a parameter out, into the fields. Nested maps become paths: {hand: {capture_radius: r}}
/// is "hand/capture_radius". No parameter lies deeper than that.
class YamlValues
{
public:
  /// @throw ParameterError for text that is no YAML map
  explicit YamlValues(const std::string& text)
  {
    if (text.size() > kMostYamlBytes) {
      throw ParameterError("the configuration is longer than " + std::to_string(kMostYamlBytes) + " bytes");
    }
    try {
      const YAML::Node root = YAML::Load(text);
      if (!root.IsMap() && !root.IsNull()) {
        throw ParameterError("the configuration is no YAML map");
      }
      flatten(root, "");
    } catch (const YAML::Exception& error) {
      throw ParameterError(std::string("the configuration is no YAML: ") + error.what());
    }
  }

  bool gives(const std::string& name) const { return values_.count(name) != 0; }

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

  void operator()(const char* name, std::string& field, const char*)
  {
    take(name, [&](const YAML::Node& node) { field = valueAs<std::string>(name, node, "a word"); });
  }

  template <typename Enum>
  void operator()(const char* name, Enum& field, const char*)
  {
    take(name,
         [&](const YAML::Node& node) { field = enumFromWord<Enum>(name, valueAs<std::string>(name, node, "a word")); });
  }

  /// @throw ParameterError for a value that no visit has taken
  void refuseRemaining() const
  {
    if (!values_.empty()) {
      const auto& unknown = *values_.begin();
      throw ParameterError(unknown.first + ": no such parameter (its value: '" + textOf(unknown.second) + "')");
    }
  }

private:
  static std::string textOf(const YAML::Node& node)
  {
    std::ostringstream text;
    text << node;
    return text.str();
  }

  template <typename T>
  static T valueAs(const std::string& name, const YAML::Node& node, const char* kind)
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

  void flatten(const YAML::Node& map, const std::string& prefix)
  {
    for (const auto& entry : map) {
      const auto name = prefix + oneLine(entry.first.as<std::string>());  // errors begin with the name
      if (entry.second.IsMap() && prefix.empty()) {
        flatten(entry.second, name + "/");
      } else {
        values_[name] = entry.second;
      }
    }
  }

  template <typename Reader>
  void take(const char* name, Reader&& read)
  {
    const auto found = values_.find(name);
    if (found != values_.end()) {
      read(found->second);
      values_.erase(found);
    }
  }

  std::map<std::string, YAML::Node> values_;
};

/// Calls read() and makes one line of its errors. @throw ParameterError
template <typename Reader>
auto withOneLineErrors(Reader&& read)
{
  try {
    return read();
  } catch (const ParameterError& error) {
    throw ParameterError(oneLine(error.what()));
  } catch (const YAML::Exception& error) {  // of a value that cannot even be quoted
    throw ParameterError(oneLine(std::string("the configuration is no YAML: ") + error.what()));
  }
}

/// Calls parse(text of the file). @throw ParameterError, with the path before what parse() throws, and for a file that
/// cannot be read
template <typename Parser>
auto parsedFile(const std::string& path, Parser&& parse)
{
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostYamlBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (!file.is_open() || file.bad()) {
    throw ParameterError(path + ": cannot be read");
  }
  try {
    return parse(text);
  } catch (const ParameterError& error) {
    throw ParameterError(path + ": " + error.what());
  }
}

}  // namespace grasp_affordances
