#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace grasp_affordances
{

#if NLOHMANN_JSON_VERSION_MAJOR > 3 || NLOHMANN_JSON_VERSION_MINOR >= 9
using Json = nlohmann::ordered_json;
#else
using Json = nlohmann::json;  // sorts the keys, which means the same
#endif

inline Json vectorJson(const Eigen::Vector3d& vector)
{
  return {vector.x(), vector.y(), vector.z()};
}

}  // namespace grasp_affordances
