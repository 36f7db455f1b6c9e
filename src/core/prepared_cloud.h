#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/neighborhoods.h"
#include "grasp_affordances/normals.h"
#include "grasp_affordances/range_image.h"

#include "core/thread_team.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// One cloud, prepared for sampling: what all samples share and none changes. Neither copied nor moved, since its parts
/// refer to one another.
struct PreparedCloud
{
  /// The cloud must outlive the prepared.
  PreparedCloud(const Cloud& cloud, const Config& config, ThreadTeam& team);
  PreparedCloud(const PreparedCloud&) = delete;
  PreparedCloud& operator=(const PreparedCloud&) = delete;

  /// Distance (m) between neighboring points at a point of the cloud; 0 without a range image.
  double spacing(const Eigen::Vector3d& point) const { return image ? image->spacing(point.z()) : 0.0; }

  const Cloud& cloud;
  std::vector<std::uint32_t> measured;  // indices of the measured points
  std::optional<RangeImage> image;
  std::vector<std::uint32_t> candidates;       // indices of the points that are sampled first
  std::unique_ptr<NeighborhoodSearch> search;  // null where there is nothing to localize
  Cloud hidden;                                // surfaces that go on behind what the sensor saw
  std::optional<RangeImage> hidden_image;
  std::unique_ptr<NeighborhoodSearch> hidden_search;  // null where no hidden surfaces are asked for
  Eigen::Vector3d sensor;                             // m, in the cloud's frame
  Normals normals;                                    // only for the Normals variation
  std::vector<std::string> warnings;
};

}  // namespace grasp_affordances
