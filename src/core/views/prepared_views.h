#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/neighborhoods/neighborhoods.h"
#include "core/neighborhoods/sphere_view.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/thread_team.h"
#include "core/shell/shell.h"
#include "core/views/prepared_cloud.h"
#include "core/views/view_agreement.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The clouds of one moment, prepared for sampling: usually one, or what several sensors saw. Those in which there is
/// nothing to localize are left out. Keeps its memory from moment to moment.
class PreparedViews
{
public:
  /// A measured point that is drawn as a sample.
  struct SamplePoint
  {
    std::size_t view;     ///< that measured it
    std::uint32_t point;  ///< its index in that view's cloud
  };

  /// Prepares other clouds, which must outlive its use.
  void update(const std::vector<PosedCloud>& views, const Config& config, const Eigen::Isometry3d& T_workspace_common,
              ThreadTeam& team);

  std::size_t size() const { return views_.size(); }
  const PreparedCloud& operator[](std::size_t view) const { return *views_[view].cloud; }
  const Eigen::Isometry3d& T_common_view(std::size_t view) const { return views_[view].T_common_cloud; }

  /// Number of a view's first point, where the points of all clouds are counted, one cloud after the other.
  std::uint32_t firstPoint(std::size_t view) const { return views_[view].first_point; }

  /// False where there is nothing to draw from.
  bool hasSamples() const { return !views_.empty() && !samplePoints().empty(); }
  SamplePoint samplePoint(const SamplingConfig& config, std::uint64_t i) const;

  /// The point of this number, where the points of all clouds are counted, one cloud after the other.
  SamplePoint viewOf(std::uint32_t point) const;

  /// Estimates, for the Normals variation, the surface normals that these samples need and that are not known yet.
  /// @throw Cancelled
  void estimateNormals(const Config& config, const SamplePoint* samples, std::size_t count, ThreadTeam& team,
                       const Cancellation& cancellation = Cancellation());

  /// Whether all views are range images.
  bool allHaveImages() const;

  /// What each view (spheres[view]) sees of a sample's neighborhood, which must be all points within a sphere. Takes
  /// less time than gather(). Only where all views are range images.
  /// @return the number of points in the sphere
  std::size_t look(const SamplePoint& sample, const Config& config, SphereView* spheres) const;

  /// A sample's neighborhood in its view's frame, and what each view sees of it. The points of the sample's view come
  /// first, then those of each other view; their indices, if asked for, are those in their own clouds. The k nearest
  /// points in several views are all points in the sphere that holds them.
  /// @param part  working memory
  void gather(const SamplePoint& sample, const Config& config, bool with_index, Neighborhood& neighborhood,
              SphereView* spheres, Neighborhood& part) const;

  /// Whether none of the views that have points in a neighborhood sees it unoccluded.
  bool occluded(const OcclusionConfig& config, const SphereView* spheres) const;

  /// Axis of the Normals variation, in the frame of the sample's view.
  std::optional<Eigen::Vector3d> normalsAxis(const SamplePoint& sample, const Neighborhood& neighborhood,
                                             const SphereView* spheres) const;

  /// Distance (m) between neighboring points at a point of a view; 0 without a range image.
  double spacing(std::size_t view, const Eigen::Vector3d& point) const;

  /// What a shell that is searched in a view's frame has around it.
  ShellSurroundings surroundings(std::size_t view, double spacing) const;

  std::uint32_t measured = 0;                                      ///< points of all clouds
  double disagreement = std::numeric_limits<double>::quiet_NaN();  ///< m, see Localization::view_disagreement
  std::vector<std::string> warnings;
  NothingSampled nothing_sampled = NothingSampled::no_cloud;  ///< the reason, where there is nothing to draw from

private:
  struct View
  {
    std::size_t number;  // among the clouds that were given, from 1
    PreparedCloud* cloud;
    Eigen::Isometry3d T_common_cloud;
    std::uint32_t first_point;
    std::size_t joined = 0;  // of its screened points
  };

  /// Two views, and by how much they disagree (m).
  struct Comparison
  {
    std::size_t first, second;
    double disagreement;
    ViewAgreement agreement;
  };

  const std::vector<std::uint32_t>& samplePoints() const { return size() == 1 ? views_[0].cloud->points() : points_; }
  const Eigen::Isometry3d& transform(std::size_t to, std::size_t from) const { return T_[to * size() + from]; }
  Eigen::Vector3f centerIn(std::size_t view, const SamplePoint& sample) const;
  float radiusOfNearest(const SamplePoint& sample, const Config& config, Neighborhood& joined,
                        Neighborhood& part) const;
  template <typename Visitor>
  void visitParts(const SamplePoint& sample, const SphereView* spheres, Visitor&& visit) const;
  void joinPoints();
  void joinScreened();
  void relateViews();
  void compareViews(ThreadTeam& team);
  void uncoverHiddenSurfaces(double margin, ThreadTeam& team);
  bool sawThrough(std::size_t view, const Eigen::Vector3d& point, double margin) const;

  std::deque<PreparedCloud> clouds_;
  std::vector<View> views_;
  std::vector<Eigen::Isometry3d> T_;              // between the views' frames: [to * size + from]
  std::vector<std::vector<OtherView>> others_;    // by view
  std::vector<std::uint32_t> points_, screened_;  // of several views, those that samples are drawn from
  std::vector<Comparison> comparisons_;
  std::vector<Neighborhood> neighborhoods_;  // two per thread
  std::vector<SphereView> spheres_;          // of each view, per thread
};

}  // namespace grasp_affordances
