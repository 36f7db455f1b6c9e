#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/InteractiveMarker.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <string>

namespace grasp_affordances
{

/// Ids of the entries in a handle's context menu.
enum class HandleMenu : std::uint32_t
{
  facts = 1,  ///< id, score and sizes; choosing it does nothing
  select,     ///< of a handle that is not selected
  deselect,   ///< of the selected one, as are the following
  next_hand_pose,
  previous_hand_pose
};

/// Of the selected handle: blue, which no scoreColor() is.
std_msgs::ColorRGBA selectedColor();

/// Name of a handle's interactive marker.
std::string handleMarkerName(std::uint32_t id);

/// A handle to click at, with a context menu of HandleMenu: a cylinder of the inner radius along each piece of its
/// axis, coloured by scoreColor() or as selected, the id beside it, and a hand, if one is given: its palm, and two
/// fingers as far apart as its width. The pose is the handle's; everything else is given in the handle's own frame, to
/// a millimetre: it does not change with the noise of a tracked handle.
/// @param hand  of the hand (not of a tool), in the frame of the header
visualization_msgs::InteractiveMarker handleMarker(const GraspHandle& handle, const std_msgs::Header& header,
                                                   bool selected, const std::optional<GraspPose>& hand,
                                                   const HandGeometry& geometry);

}  // namespace grasp_affordances
