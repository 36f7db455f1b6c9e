#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{

/// Draws shells and handles for rviz, in these namespaces:
/// - shells: a translucent cylinder per shell, of its inner radius and length; id: index of the shell
/// - axes: its axis; the same id. Both are faint where the shell is of a handle
/// - handles: a tube per handle along its axis, 2 mm wider than its surface, coloured by scoreColor(); id: the handle's
/// - handle_ids: that id as a text beside it; the same id
/// - hand_poses: a handle's eight best open hands, finger, thumb and palm as lines, the best one bright; the same id
/// - workspace: the box that samples are drawn in, where it is a limit; id 0
/// Markers live until they are replaced or deleted. Of one thread.
class LocalizationMarkers
{
public:
  /// Markers of a result, and deletions of what is not shown any more, here and in the next 100 arrays: a
  /// viewer that missed some arrays shows no stale marker after the next one. The first call also deletes whatever an
  /// earlier publisher left behind.
  /// @param shells  of one cloud
  /// @param handles  found in it, with indices into its shells, or tracked up to it
  /// @param header  of both
  /// @param workspace_frame  that the box of config.workspace is in
  visualization_msgs::MarkerArray update(const std::vector<Shell>& shells, const std::vector<GraspHandle>& handles,
                                         const Config& config, const std_msgs::Header& header,
                                         const std::string& workspace_frame);

private:
  void deleteSurplus(visualization_msgs::MarkerArray& array, const std_msgs::Header& header);

  bool first_ = true;
  std::map<std::pair<std::string, std::int32_t>, int> known_;  // by namespace and id: arrays that still delete it
};

}  // namespace grasp_affordances
