#pragma once

#include <cstddef>
#include <string>

namespace grasp_affordances
{

/// Text from a file, as a message may show it: valid UTF-8 stays, control characters and other bytes become \xNN.
/// @param longest  bytes of the result; of a longer text the beginning is shown, with "..."
std::string printable(const std::string& text, std::size_t longest = 60);

/// As printable, in quotes.
std::string quoted(const std::string& text);

}  // namespace grasp_affordances
