#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/cloud/range_image.h"
#include "core/cloud/usable_cloud.h"
#include "core/fit/surface_normals.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/neighborhoods/tree_search.h"
#include "core/neighborhoods/window_search.h"
#include "core/parallel/thread_team.h"
#include "core/views/hidden_surfaces.h"
#include "core/views/point_screen.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The warning of a cloud, or of the clouds of a moment, in which no sample is drawn.
std::string nothingToLocalize(NothingSampled reason);

/// One cloud, prepared for sampling: what all samples read and none changes. Keeps its memory from cloud to cloud. It
/// is neither copied nor moved, since its parts refer to one another.
class PreparedCloud
{
public:
  PreparedCloud() = default;
  PreparedCloud(const PreparedCloud&) = delete;
  PreparedCloud& operator=(const PreparedCloud&) = delete;

  /// Prepares another cloud. The cloud must stay as it is for as long as this one is used.
  void update(const Cloud& cloud, const Config& config, const Eigen::Isometry3d& T_workspace_cloud, ThreadTeam& team);

  /// Gathers the points within a sphere, with or without their indices. Safe to call from many threads.
  /// @return what the sensor sees of the sphere; without a range image the number of its points alone
  SphereView gather(const Eigen::Vector3f& center, float radius, bool with_index, Neighborhood& neighborhood) const;

  /// Gathers the k nearest points. Safe to call from many threads.
  /// @return what the sensor sees of their sphere; without a range image, or without `with_view`, their number alone
  SphereView gatherNearest(const Eigen::Vector3f& center, std::size_t k, bool with_view,
                           Neighborhood& neighborhood) const;

  /// Distance (m) between neighboring points, as their number within a radius (m) tells for surfaces: the median over
  /// some points. Only where there is something to localize.
  double spacing(double radius) const;

  /// The points that samples are drawn from: the measured ones within the workspace.
  const std::vector<std::uint32_t>& drawablePoints() const { return limited_ ? within_ : measured; }

  /// Whether samples may be drawn at a measured point.
  bool allows(std::uint32_t point) const { return !limited_ || is_within_[point] != 0; }

  /// Searches the range image; null where there is none.
  const WindowSearch* windowSearch() const { return image && window_search_ ? &*window_search_ : nullptr; }

  const Cloud* cloud = nullptr;         // without points that are left out, see UsableCloud
  std::vector<std::uint32_t> measured;  // indices of its measured points
  std::optional<RangeImage> image;
  PointScreen screen;                             // empty without an image
  const NeighborhoodSearch* search = nullptr;     // null where there is nothing to localize
  HiddenSurfaces hidden;                          // surfaces that go on behind others; valid with hidden_search
  std::optional<RangeImage> hidden_image;         // of `hidden`
  std::optional<WindowSearch> hidden_search;      // in `hidden`; none without an image, or where they are not asked for
  std::optional<Eigen::Vector3d> sensor;          // m, in the cloud's frame; empty where it is not known
  SurfaceNormals normals;                         // for the Normals variation only
  std::optional<NothingSampled> nothing_sampled;  // why there is nothing to localize; empty where there is something
  std::vector<std::string> warnings;

private:
  void leaveOut(NothingSampled reason);
  void listMeasured();
  bool allCoincide() const;
  void suspectUnit();
  void suspectPrecision(double finger_thickness);
  void findWorkspace(const WorkspaceConfig& workspace, const Eigen::Isometry3d& T_workspace_cloud, ThreadTeam& team);

  UsableCloud usable_;
  std::optional<WindowSearch> window_search_;
  TreeSearch tree_search_;
  bool limited_ = false;                 // whether a workspace limits where samples are drawn
  std::vector<std::uint32_t> within_;    // where limited, the measured points within the workspace
  std::vector<std::uint8_t> is_within_;  // where limited, per point
};

}  // namespace grasp_affordances
