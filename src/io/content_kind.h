#pragma once

#include <string>

namespace grasp_affordances
{

/// What a file seems to be, in words that fit behind "but": "a PLY file", "text", "binary data".
/// @param begin  its first bytes, at least some hundred if it has so many
std::string contentKind(const std::string& begin);

/// What the first bytes of all bags are, of any version.
constexpr const char* kBagMagic = "#ROSBAG V";

}  // namespace grasp_affordances
