#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>

namespace grasp_affordances
{

/// A message that quotes what somebody else wrote, as one line that can be read: spaces for control characters, and
/// without its middle where it is long.
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
