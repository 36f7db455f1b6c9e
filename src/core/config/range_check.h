#pragma once

#include "grasp_affordances/parameters.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A visitor for visitParameters() and its like that refuses values outside their range. NaN lies outside every range.
class RangeCheck
{
public:
  template <typename T>
  void operator()(const char* name, const T& value, const Range<T>& range, const char* unit, const char*) const
  {
    if (!(value >= range.min && value <= range.max)) {
      std::ostringstream message;
      message << name << ": " << value << " is outside the allowed range [" << range.min << ", " << range.max << "]"
              << (*unit != '\0' ? " " : "") << unit;
      throw ParameterError(message.str());
    }
  }

  template <typename T>
  void operator()(const char*, const T&, const char*) const
  {
  }
};

inline std::string listed(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

/// The value of an enumeration for one of its words. @throw ParameterError for another word
template <typename Enum>
Enum findWord(const std::string& name, const std::string& word)
{
  const std::vector<std::string>& words = enumWords<Enum>();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    throw ParameterError(name + ": '" + word + "' is none of: " + listed(words));
  }
  return static_cast<Enum>(found - words.begin());
}

}  // namespace grasp_affordances
