#pragma once

#include "grasp_affordances/config.h"

#include <Eigen/Geometry>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A cloud that is localized in together with others.
struct ViewFile
{
  std::string file;                                 ///< PCD
  std::optional<Eigen::Isometry3d> T_common_cloud;  ///< empty: the file's VIEWPOINT
};

/// What the command line of `localize` asks for.
struct LocalizeOptions
{
  std::vector<std::string> inputs;  ///< PCD files and bags, each localized in on its own
  std::vector<ViewFile> views;      ///< one cloud together, then there are no inputs
  Config config;                    ///< validated
  std::string topic;                ///< of the bags; empty: their only one
  std::string picture;              ///< path of the pictures; empty: none
  bool json = false;
  std::optional<Eigen::Vector3f> viewpoint;  ///< m, place of the sensor in the frame of each input; empty: as files say
};

/// A command line that makes no sense. what() is one line.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The preset is read first, the config file over it, and single options over both.
/// @return empty where help or the version was asked for; it has been printed.
/// @throw UsageError, and ParameterError for a value that the config refuses.
std::optional<LocalizeOptions> parseLocalizeOptions(int argc, const char* const* argv);

}  // namespace grasp_affordances
