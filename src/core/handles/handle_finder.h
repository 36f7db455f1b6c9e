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
  const PreparedViews::SamplePoint* samples;  ///< all points that samples were drawn at
  std::size_t sample_count;
  const std::vector<Shell>& shells;  ///< of these samples
};

/// Groups shells that share an axis into handles, and fits their axis and radius to the cloud's points inside them.
///
/// The score of a handle is the geometric mean of five numbers in [0, 1]:
/// - support, n / (n + 5) of n shells;
/// - agreement: of the samples drawn within it the share that ended as one of its shells, 0.3 or more counting as 1; of
/// that
///   the square root;
/// - clearance: 1 minus the mean of points in the gap over gap_points_to_block for each clearance length, which does
///   not follow the density of points here;
/// - observed free space: twice the mean share of the gaps that the sensor saw through, at most 1; left out without a
///   range image;
/// - length over twice the clearance length, at most 1.
///
/// Equal shells in another order give equal handles. Keeps its memory.
class HandleFinder
{
public:
  /// The handles of the shells of one localization, the best first, without hand poses.
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
  std::vector<const Shell*> members_;  // of the handle that is worked on
  AxisTracer tracer_;
  SharedAxis axis_;
  Neighborhood neighborhood_;
  std::vector<double> radii_;  // m, of the shells, or of the pieces of a bent handle
  std::vector<Eigen::Vector3d> points_, near_;
  Polyline traced_;
  std::vector<Eigen::Vector3d> samples_;  // m, in the common frame
  std::vector<GraspHandle> spare_;        // whose memory will be used again
};

}  // namespace grasp_affordances
