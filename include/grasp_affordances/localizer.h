#pragma once

#include "grasp_affordances/cancelled.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace grasp_affordances
{

/// Where one sample of a localization ended.
struct SampleEnd
{
  std::uint32_t point_index = 0;  ///< of the sampled point, as Shell::point_index
  Outcome outcome = Outcome::too_few_points;
};

/// Localizes enveloping grasp affordances in point clouds (paper, Algorithm 1).
///
/// The result depends on the cloud, the configuration and its seed alone: not on the number of threads, nor on clouds
/// seen before. One instance serves one caller at a time; it keeps its working memory from cloud to cloud.
class Localizer
{
public:
  /// @throw ParameterError for a value outside its range.
  explicit Localizer(const Config& config = Config());
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Never fails for what a cloud holds: a cloud without a usable point gives no samples, no shells and a warning.
  Localization localize(const Cloud& cloud);

  /// The same, into a result whose memory is used again. Allocates nothing for an organized cloud with intrinsics, of a
  /// size seen before, except where a list has to grow.
  /// @param T_workspace_cloud  from the cloud's frame to that of the box of WorkspaceConfig
  /// @param T_approach_cloud  from the cloud's frame to that in which HandPosesConfig gives the direction of approach
  void localize(const Cloud& cloud, Localization& result,
                const Eigen::Isometry3d& T_workspace_cloud = Eigen::Isometry3d::Identity(),
                const Eigen::Isometry3d& T_approach_cloud = Eigen::Isometry3d::Identity());

  /// Localizes in several clouds of the same moment, as seen by several sensors (paper, section IV-A). Samples are
  /// drawn from all of them; neighborhoods and clearance are searched in all of them. A neighborhood is kept when at
  /// least one view with points in it sees it unoccluded; free space that one view observed is free, and blocks what
  /// another took to be hidden there.
  ///
  /// Shells are in the common frame, and their normals point towards the sensor that saw the sample. Each cloud has a
  /// sensor of its own, see Cloud::sensor_origin. `point_index` counts the points of all clouds, one cloud after the
  /// other. A single cloud at the origin gives the same result as without a pose. A cloud without a usable point, or
  /// with a pose that is not finite, is left out, with a warning.
  /// @param T_workspace_common  from the common frame to that of the box of WorkspaceConfig
  /// @param T_approach_common  from the common frame to that in which HandPosesConfig gives the direction of approach
  void localize(const std::vector<PosedCloud>& views, Localization& result,
                const Eigen::Isometry3d& T_workspace_common = Eigen::Isometry3d::Identity(),
                const Eigen::Isometry3d& T_approach_common = Eigen::Isometry3d::Identity());

  /// Where the samples of the last localization ended, in their order. Empty before the first one; not valid after one
  /// that was cancelled.
  std::vector<SampleEnd> sampleEnds() const;

  const Config& config() const;

  /// Takes other parameters. Results are then those of a new instance; the working memory is kept.
  /// @throw ParameterError for a value outside its range; nothing has changed then.
  void configure(const Config& config);

  /// Lets localize() end early: soon after `wanted` returns true it throws Cancelled, and its result is unspecified.
  /// `wanted` is called from several threads, between pieces of work of some ms, and must not throw. One piece takes
  /// longer, for clouds of millions of points: their preparation, with the k-d tree of an unorganized cloud.
  void cancelWhen(std::function<bool()> wanted);

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace grasp_affordances
