#include "nodelets/parameters/reconfiguration.h"

#include "grasp_affordances/LocalizerConfig.h"
#include "grasp_affordances/parameters.h"

#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

namespace grasp_affordances
{
namespace
{

using dynamic_reconfigure::ConfigTools;
using Message = dynamic_reconfigure::Config;

Message messageOf(const LocalizerConfig& config)
{
  Message message;
  config.__toMessage__(message);
  return message;
}

template <typename T>
T valueOf(const Message& message, const std::string& name)
{
  T value = T();
  EXPECT_TRUE(ConfigTools::getParameter(message, name, value)) << name << " is missing, or of another type";
  return value;
}

/// Compares cfg/Localizer.cfg with the parameters.
class Comparison
{
public:
  template <typename Number>
  void operator()(const char* path, const Number& field, const Range<Number>& range, const char* unit,
                  const char* description)
  {
    using Sent = std::conditional_t<std::is_same<Number, int>::value, int, double>;
    const std::string name = flatName(path);
    EXPECT_EQ(valueOf<Sent>(defaults_, name), static_cast<Sent>(field)) << name;
    EXPECT_EQ(valueOf<Sent>(least_, name), static_cast<Sent>(range.min)) << name;
    EXPECT_EQ(valueOf<Sent>(most_, name), static_cast<Sent>(range.max)) << name;
    describe(path, *unit == '\0' ? description : std::string(description) + " [" + unit + "]");
  }

  void operator()(const char* path, const bool& field, const char* description)
  {
    EXPECT_EQ(valueOf<bool>(defaults_, flatName(path)), field) << path;
    describe(path, description);
  }

  template <typename Enum>
  std::enable_if_t<std::is_enum<Enum>::value> operator()(const char* path, const Enum& field, const char* description)
  {
    const std::string name = flatName(path);
    EXPECT_EQ(valueOf<std::string>(defaults_, name), enumWord(field)) << name;
    describe(path, description);
    for (const std::string& word : enumWords<Enum>()) {
      EXPECT_NE(descriptions_[name].edit_method.find("'" + word + "'"), std::string::npos)
          << word << " is no choice of " << name;
    }
  }

  void expectNoOthers() const
  {
    for (const auto& [name, description] : descriptions_) {
      EXPECT_EQ(compared_.count(name), 1U) << name << " is no parameter";
    }
  }

private:
  void describe(const std::string& path, const std::string& text)
  {
    const std::string name = flatName(path);
    compared_.insert(name);
    EXPECT_EQ(descriptions_[name].description, text) << name;
    const std::string group = path.find('/') == std::string::npos ? "Default" : path.substr(0, path.find('/'));
    EXPECT_EQ(groups_[name], group) << name;
  }

  // cppcheck-suppress unusedPrivateFunction; descriptions_ is initialized with it
  static std::map<std::string, dynamic_reconfigure::ParamDescription> descriptions()
  {
    std::map<std::string, dynamic_reconfigure::ParamDescription> result;
    for (const auto& parameter : LocalizerConfig::__getParamDescriptions__()) {
      result[parameter->name] = *parameter;  // NOLINT(cppcoreguidelines-slicing): all of it that is a message
    }
    return result;
  }

  // cppcheck-suppress unusedPrivateFunction; groups_ is initialized with it
  static std::map<std::string, std::string> groups()
  {
    std::map<std::string, std::string> result;
    for (const auto& group : LocalizerConfig::__getGroupDescriptions__()) {
      for (const auto& parameter : group->parameters) {
        result[parameter.name] = group->name;
      }
    }
    return result;
  }

  const Message defaults_ = messageOf(LocalizerConfig::__getDefault__());
  const Message least_ = messageOf(LocalizerConfig::__getMin__());
  const Message most_ = messageOf(LocalizerConfig::__getMax__());
  std::map<std::string, dynamic_reconfigure::ParamDescription> descriptions_ = descriptions();
  std::map<std::string, std::string> groups_ = groups();
  std::set<std::string> compared_;
};

TEST(Reconfiguration, OffersTheParametersWithTheirDefaultsAndRanges)
{
  const Config config;
  Comparison comparison;
  visitParameters(config, comparison);
  comparison.expectNoOthers();
}

/// Every parameter at another value than its default.
class Alter
{
public:
  template <typename Number>
  void operator()(const char*, Number& field, const Range<Number>& range, const char*, const char*) const
  {
    field = field == range.max ? range.min : range.max;
  }

  void operator()(const char*, bool& field, const char*) const { field = !field; }

  template <typename Enum>
  std::enable_if_t<std::is_enum<Enum>::value> operator()(const char*, Enum& field, const char*) const
  {
    field = static_cast<Enum>(enumWords<Enum>().size() - 1 - static_cast<std::size_t>(field));
  }
};

/// All values as text.
class Text
{
public:
  template <typename T, typename... Others>
  void operator()(const char* name, const T& field, const Others&...)
  {
    text_ << name << ' ';
    if constexpr (std::is_enum<T>::value) {
      text_ << enumWord(field) << '\n';
    } else {
      text_ << std::hexfloat << field << '\n';
    }
  }

  std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
};

std::string textOf(const Config& config)
{
  Text text;
  visitParameters(config, text);
  return text.text();
}

TEST(Reconfiguration, EveryValueGoesThroughAMessageUnchanged)
{
  Config altered;
  visitParameters(altered, Alter());
  Config result;
  assign(toReconfigureMessage(altered), result);
  EXPECT_EQ(textOf(result), textOf(altered));
  EXPECT_NE(textOf(result), textOf(Config()));

  LocalizerConfig generated;  // as the server has them
  Message message = toReconfigureMessage(altered);
  EXPECT_TRUE(generated.__fromMessage__(message));
  Config again;
  assign(messageOf(generated), again);
  EXPECT_EQ(textOf(again), textOf(altered));
}

TEST(Reconfiguration, WhatAMessageDoesNotHoldStays)
{
  Config altered;
  visitParameters(altered, Alter());
  Config result = altered;
  Message message;
  ConfigTools::appendParameter(message, "hand_capture_radius", 0.03);
  assign(message, result);
  EXPECT_EQ(result.hand.capture_radius, 0.03);
  result.hand.capture_radius = altered.hand.capture_radius;
  EXPECT_EQ(textOf(result), textOf(altered));
}

TEST(Reconfiguration, RefusesWordsAndSeedsThatAreNone)
{
  const auto refusal = [](const std::string& name, const auto& value) {
    Message message;
    ConfigTools::appendParameter(message, name, value);
    Config config;
    try {
      assign(message, config);
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("estimation_estimator", std::string("taubing")).find("taubing"), std::string::npos);
  EXPECT_NE(refusal("sampling_seed", 1.5).find("sampling/seed: 1.5"), std::string::npos);
  EXPECT_NE(refusal("sampling_seed", -1.0).find("-1"), std::string::npos);
  EXPECT_EQ(refusal("sampling_seed", 9007199254740991.0), "");
}

}  // namespace
}  // namespace grasp_affordances
