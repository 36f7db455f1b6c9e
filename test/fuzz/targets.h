#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace grasp_affordances::fuzz
{

/// Each hands an input to one of the package's borders. What the border documents as its answer to bad input is caught;
/// everything else that goes wrong ends the process.
void fuzzBag(const std::uint8_t* data, std::size_t size);
void fuzzConfigYaml(const std::uint8_t* data, std::size_t size);
void fuzzCore(const std::uint8_t* data, std::size_t size);
void fuzzLabelsJson(const std::uint8_t* data, std::size_t size);
void fuzzPcd(const std::uint8_t* data, std::size_t size);
void fuzzPointCloud2(const std::uint8_t* data, std::size_t size);

struct Target
{
  const char* name;
  void (*run)(const std::uint8_t* data, std::size_t size);
};

constexpr Target kTargets[] = {{"bag", fuzzBag},   {"config_yaml", fuzzConfigYaml},
                               {"core", fuzzCore}, {"labels_json", fuzzLabelsJson},
                               {"pcd", fuzzPcd},   {"point_cloud2", fuzzPointCloud2}};

/// Ends the process with a message where something does not hold that must, whatever the input.
void require(bool holds, const char* what);

/// A reason that is given to people: one line, and short enough to be read.
void requireOneLine(const std::string& reason);

}  // namespace grasp_affordances::fuzz
