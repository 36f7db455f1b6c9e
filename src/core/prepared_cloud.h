#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/neighborhoods.h"
#include "grasp_affordances/range_image.h"
#include "grasp_affordances/sampling.h"

#include "core/hidden_surfaces.h"
#include "core/point_screen.h"
#include "core/surface_normals.h"
#include "core/thread_team.h"
#include "core/window_search.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// One cloud, prepared for sampling: what all samples share and none changes. Keeps its memory from cloud to cloud.
/// Neither copied nor moved, since its parts refer to one another.
class PreparedCloud
{
public:
  PreparedCloud() = default;
  PreparedCloud(const PreparedCloud&) = delete;
  PreparedCloud& operator=(const PreparedCloud&) = delete;

  /// Prepares another cloud, which must outlive its use.
  void update(const Cloud& cloud, const Config& config, ThreadTeam& team);

  /// The neighborhood of a point, given by its index in the cloud. Safe to call from many threads.
  void findNeighborhood(std::uint32_t point, const Config& config, Neighborhood& neighborhood) const;

  /// The i-th sample's point, by its index in the cloud.
  std::uint32_t samplePoint(const Config& config, std::uint64_t i) const
  {
    return grasp_affordances::samplePoint(measured, screen.points(), config.sampling, i);
  }

  /// Where a neighborhood is all points within a sphere: its radius (m).
  static float neighborhoodRadius(const Config& config)
  {
    const double radius = config.neighborhood.radius;
    return static_cast<float>(radius > 0.0 ? radius : config.hand.capture_radius);
  }

  /// Searches the range image; null where there is none.
  const WindowSearch* windowSearch() const { return image && window_search_ ? &*window_search_ : nullptr; }

  /// Distance (m) between neighboring points at a point of the cloud; 0 without a range image.
  double spacing(const Eigen::Vector3d& point) const { return image ? image->spacing(point.z()) : 0.0; }

  const Cloud* cloud = nullptr;
  std::vector<std::uint32_t> measured;  // indices of the measured points
  std::optional<RangeImage> image;
  PointScreen screen;
  const NeighborhoodSearch* search = nullptr;  // null where there is nothing to localize
  HiddenSurfaces hidden;                       // that go on behind what the sensor saw; with an image only
  std::optional<RangeImage> hidden_image;
  std::optional<WindowSearch> hidden_search;         // none where no hidden surfaces are asked for
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  // m, in the cloud's frame
  SurfaceNormals normals;                            // only for the Normals variation
  std::vector<std::string> warnings;

private:
  void listMeasured();
  bool allCoincide() const;
  void estimateNormals(const Config& config, ThreadTeam& team);

  std::optional<WindowSearch> window_search_;
  std::unique_ptr<NeighborhoodSearch> tree_search_;
  std::vector<Neighborhood> neighborhoods_;  // one per thread
};

}  // namespace grasp_affordances
