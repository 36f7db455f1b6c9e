#pragma once

#include "grasp_affordances/localization.h"

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstddef>

namespace grasp_affordances
{

/// Draws localizations for rviz: in namespace "shells" a translucent cylinder per shell, of its inner radius and
/// length, in namespace "axes" its axis. The id of a marker is the index of its shell; markers live until they are
/// replaced or deleted.
class ShellMarkers
{
public:
  /// Markers of the shells, and deletions of all other ids that were ever used: a viewer that missed an array shows no
  /// stale marker after the next one. The first call also deletes whatever an earlier publisher left behind.
  visualization_msgs::MarkerArray update(const Localization& localization, const std_msgs::Header& header);

private:
  bool first_ = true;
  std::size_t drawn_ = 0;  // most shells of any call
};

}  // namespace grasp_affordances
