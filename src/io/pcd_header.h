#pragma once

#include "io/pcd.h"

#include <pcl/PCLPointField.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Name of fields of a PCD file that hold nothing.
constexpr const char* kPcdPadding = "_";

enum class PcdEncoding
{
  ascii,
  binary,
  compressed
};

/// What the header of a PCD file says of the points that follow it.
struct PcdHeader
{
  std::vector<pcl::PCLPointField> fields;
  std::uint64_t point_step = 0;        ///< bytes
  std::uint64_t values_per_point = 0;  ///< numbers in a line of an ascii file
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  SensorPose viewpoint;
  PcdEncoding encoding = PcdEncoding::ascii;
  std::size_t size = 0;      ///< bytes of the header itself
  std::string unknown_keys;  ///< what an error adds on lines that were skipped; empty where there are none

  std::uint64_t points() const { return width * height; }
};

/// Reads and checks a header from the file's first byte on. Lines with an unknown key are skipped.
/// @throw CloudError for a file that is no PCD file, or whose header contradicts itself
PcdHeader readPcdHeader(std::istream& file);

}  // namespace grasp_affordances
