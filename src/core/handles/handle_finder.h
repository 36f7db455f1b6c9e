#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"

#include "core/handles/bar_fit.h"
#include "core/handles/handle_axis.h"
#include "core/handles/shell_groups.h"
#include "core/parallel/cancellation.h"
#include "core/views/prepared_views.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What was found in the clouds of a moment before handles are looked for.
struct SampledShells
{
  const PreparedViews::MeasuredPoint* samples;  ///< all points that samples were drawn at
  std::size_t sample_count;
  const std::vector<Shell>& shells;  ///< of these samples
};

/// Groups shells that share an axis into handles, and fits each handle's axis and radius to the cloud's points inside
/// its shells.
///
/// The score of a handle is the geometric mean of five numbers in [0, 1]:
/// - **support**: n / (n + 5) for n shells;
/// - **agreement**: the square root of a / 0.3, at most 1, where a is the share of the samples drawn within the handle
///   that ended as one of its shells;
/// - **clearance**: 1 minus the mean, over the shells, of the number of points in the gap over the number that blocks a
///   gap of this length. That number is `gap_points_to_block` per clearance length. It is not scaled with the density
///   of points here;
/// - **observed free space**: twice the mean share of the gaps that the sensor saw through, at most 1. Left out without
/// a
///   range image: the mean is then that of four numbers;
/// - **length**: the length over twice the clearance length, at most 1.
///
/// The same shells in another order give the same handles. Keeps its memory.
class HandleFinder
{
public:
  /// Finds the handles of one localization, without hand poses. The best comes first.
  /// @param handles  the result; what it held before is replaced, and its memory used again
  /// @throw Cancelled
  void find(const PreparedViews& views, const Config& config, const SampledShells& found,
            std::vector<GraspHandle>& handles, const Cancellation& cancellation = Cancellation());

private:
  void addSpare(std::vector<GraspHandle>& handles);
  void describe(const PreparedViews& views, const Config& config, GraspHandle& handle);
  void gatherPoints(const PreparedViews& views, const Eigen::Vector3d& center, double radius);
  void keepAlong(const FittedBar& bar, double half_length, double radius);
  void fitLine(const PreparedViews& views, GraspHandle& handle);
  void fitBend(const PreparedViews& views, GraspHandle& handle);
  double agreement(const GraspHandle& handle) const;
  void rate(const Config& config, GraspHandle& handle) const;

  ShellGroups groups_;
  std::vector<const Shell*> members_;  // of the current handle
  AxisTracer tracer_;
  SharedAxis axis_;
  Neighborhood neighborhood_;
  std::vector<double> radii_;  // m, of the shells, or of the bars along a bent handle
  std::vector<Eigen::Vector3d> points_, near_;
  Polyline traced_;
  std::vector<Eigen::Vector3d> samples_;  // m, in the common frame
  std::vector<GraspHandle> spare_;        // kept for their memory
};

}  // namespace grasp_affordances
