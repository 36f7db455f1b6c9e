#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/neighborhoods/neighborhoods.h"
#include "core/neighborhoods/sphere_view.h"
#include "core/neighborhoods/surroundings.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/thread_team.h"
#include "core/views/prepared_cloud.h"
#include "core/views/view_comparison.h"

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

/// The clouds of one moment, prepared for sampling: one, or one for each of several sensors. A view is a cloud in which
/// there is something to localize; the other clouds are left out. Keeps its memory from moment to moment.
class PreparedViews
{
public:
  /// A measured point of one of the views.
  struct MeasuredPoint
  {
    std::size_t view;     ///< that measured it
    std::uint32_t point;  ///< its index in that view's cloud
  };

  /// Prepares other clouds. They must stay as they are for as long as the views are used.
  void update(const std::vector<PosedCloud>& views, const Config& config, const Eigen::Isometry3d& T_workspace_common,
              ThreadTeam& team);

  std::size_t size() const { return views_.size(); }
  const PreparedCloud& operator[](std::size_t view) const { return *views_[view].cloud; }
  const Eigen::Isometry3d& T_common_view(std::size_t view) const { return views_[view].T_common_cloud; }

  /// Number of a view's first point. The points of all clouds are numbered, one cloud after the other.
  std::uint32_t firstPoint(std::size_t view) const { return views_[view].first_point; }

  /// Whether there is a point that a sample can be drawn at.
  bool hasSamples() const { return !views_.empty() && !drawablePoints().empty(); }
  MeasuredPoint drawAnywhere(const SamplingConfig& config, std::uint64_t i) const;

  /// The point of this number. The points of all clouds are numbered, one cloud after the other.
  MeasuredPoint viewOf(std::uint32_t point) const;

  /// Estimates the surface normals that the Normals variation needs for these samples and that are not known yet.
  /// @throw Cancelled
  void estimateNormals(const Config& config, const MeasuredPoint* samples, std::size_t count, ThreadTeam& team,
                       const Cancellation& cancellation = Cancellation());

  /// Whether all views are range images.
  bool allHaveImages() const;

  /// Tells what each view sees of a sample's neighborhood, without gathering the points, in less time than gather().
  /// Only for neighborhoods of all points within a sphere, and only where all views are range images.
  /// @param spheres  by view, out
  /// @return the number of points in the sphere
  std::size_t look(const MeasuredPoint& sample, const Config& config, SphereView* spheres) const;

  /// Gathers a sample's neighborhood in the frame of the sample's view, and tells what each view sees of it. The points
  /// of the sample's view come first, then those of each other view. Their indices are those in their own clouds. Where
  /// there are several views, the k nearest points of all of them determine a sphere, and all points in it are
  /// gathered.
  /// @param with_index  whether the indices are asked for
  /// @param spheres  by view, out
  /// @param part  working memory
  void gather(const MeasuredPoint& sample, const Config& config, bool with_index, Neighborhood& neighborhood,
              SphereView* spheres, Neighborhood& part) const;

  /// Whether a neighborhood is occluded in every view that has points in it.
  bool occluded(const OcclusionConfig& config, const SphereView* spheres) const;

  /// The axis of the Normals variation for a gathered neighborhood, in the frame of the sample's view.
  std::optional<Eigen::Vector3d> normalsAxis(const MeasuredPoint& sample, const Neighborhood& neighborhood,
                                             const SphereView* spheres) const;

  /// Distance (m) between neighboring points at a point of a view; 0 without a range image.
  double spacing(std::size_t view, const Eigen::Vector3d& point) const;

  /// What surrounds a shell that is searched in a view's frame.
  /// @param spacing  m, between neighboring points; 0: unknown
  ShellSurroundings surroundings(std::size_t view, double spacing) const;

  std::uint32_t measured = 0;                                      ///< points of all clouds
  double disagreement = std::numeric_limits<double>::quiet_NaN();  ///< m, see Localization::view_disagreement
  std::vector<std::string> warnings;
  NothingSampled nothing_sampled = NothingSampled::no_cloud;  ///< the reason, where there is nothing to draw from

private:
  struct View
  {
    std::size_t number;  // of the cloud among those that were given, from 1
    PreparedCloud* cloud;
    Eigen::Isometry3d T_common_cloud;
    std::uint32_t first_point;
    std::size_t joined = 0;  // how many of its screened points are in screened_
  };

  const std::vector<std::uint32_t>& drawablePoints() const
  {
    return size() == 1 ? views_[0].cloud->drawablePoints() : points_;
  }
  const Eigen::Isometry3d& transform(std::size_t to, std::size_t from) const { return T_[to * size() + from]; }
  Eigen::Vector3f centerIn(std::size_t view, const MeasuredPoint& sample) const;
  float radiusOfNearest(const MeasuredPoint& sample, const Config& config, Neighborhood& joined,
                        Neighborhood& part) const;
  template <typename Visitor>
  void visitParts(const MeasuredPoint& sample, const SphereView* spheres, Visitor&& visit) const;
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
  std::vector<std::uint32_t> points_, screened_;  // of several views: points that samples may be drawn at, by number
  std::vector<ComparedView> compared_;
  ViewComparison comparison_;
  std::vector<Neighborhood> neighborhoods_;  // two per thread
  std::vector<SphereView> spheres_;          // of each view, per thread
};

}  // namespace grasp_affordances
