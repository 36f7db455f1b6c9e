#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <ostream>
#include <string>

namespace grasp_affordances
{

/// Where a cloud came from.
struct CloudSource
{
  std::string file;      ///< as given on the command line
  std::string frame_id;  ///< empty where the file names none
  double stamp = 0.0;    ///< s; 0 where the file has none
};

/// One line of JSON, without its end: lengths in metres, null for what is not known.
std::string toJson(const CloudSource& source, const Config& config, const Localization& localization);

/// A heading and the first shells, for people.
void printTable(std::ostream& out, const CloudSource& source, const Config& config, const Localization& localization);

/// Why a cloud has no shells: in how many samples each stage ended.
std::string explainNothing(const Localization& localization);

}  // namespace grasp_affordances
