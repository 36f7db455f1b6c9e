#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// One of several clouds that were localized in together.
struct ViewSource
{
  std::string file;  ///< as given on the command line
  Eigen::Isometry3d T_common_cloud;
  std::size_t points;             ///< measured ones
  std::size_t first_point_index;  ///< of this view's points among those of all, as Shell::point_index counts them
};

/// Where a cloud came from.
struct CloudSource
{
  std::string file;                 ///< as given on the command line; of several views the first
  std::string frame_id;             ///< empty where the file names none
  double stamp = 0.0;               ///< s; 0 where the file has none
  std::vector<ViewSource> views{};  ///< empty for a cloud without others

  /// For people: all files.
  std::string name() const;
};

/// One line of JSON, without its end: lengths in metres, null for what is not known.
std::string toJson(const CloudSource& source, const Config& config, const Localization& localization);

/// A heading, the first handles, and how many shells there are, for people.
void printTable(std::ostream& out, const CloudSource& source, const Config& config, const Localization& localization);

}  // namespace grasp_affordances
