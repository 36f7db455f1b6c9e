#pragma once

#include "grasp_affordances/cloud.h"
#include "rendering/color.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// One of several clouds that are localized in together, as read from its file.
struct PosedView
{
  Cloud cloud;                ///< in a frame of its own
  std::vector<Color> colors;  ///< of the points; empty where the file has none
  Eigen::Isometry3d T_common_cloud;

  std::size_t measuredPoints() const;
};

/// @param T_common_cloud empty: the pose that VIEWPOINT tells. Where that is not the default one, it is the sensor's,
/// and the sensor is at the origin of the cloud's frame.
/// @throw CloudError for a file that cannot be read, and for a VIEWPOINT that is no pose.
PosedView readPosedView(const std::string& file, const std::optional<Eigen::Isometry3d>& T_common_cloud);

/// All points of all views in the common frame, one view after the other.
/// @param colors receives theirs, with grey for views that have none; empty where no view has any
Cloud cloudInCommonFrame(const std::vector<PosedView>& views, std::vector<Color>& colors);

}  // namespace grasp_affordances
