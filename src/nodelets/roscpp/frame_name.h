#pragma once

#include <string>

namespace grasp_affordances
{

/// The name of a frame as tf2 knows it: without the leading slash that older drivers and bags write.
inline std::string frameName(std::string name)
{
  name.erase(0, name.find_first_not_of('/'));
  return name;
}

}  // namespace grasp_affordances
