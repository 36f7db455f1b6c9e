#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>

namespace grasp_affordances
{

/// Makes one readable line of a message that quotes text from outside: control characters become spaces, and a long
/// message loses its middle.
inline std::string oneLine(std::string text)
{
  constexpr std::size_t kLongest = 400, kEnd = 150;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  if (text.size() > kLongest) {
    text.replace(kLongest - kEnd, text.size() - kLongest, " ... ");
  }
  return text;
}

}  // namespace grasp_affordances
