#pragma once

#include "core/tracking/handle_likeness.h"
#include "grasp_affordances/handle.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// A handle, averaged over the clouds that it was found in. Its frame is one in which handles stand still.
class TrackedHandle
{
public:
  TrackedHandle(const GraspHandle& found, double stamp);

  /// Takes in what was found of it in another cloud.
  /// @param found  the handle as it was found
  /// @param pieces  further pieces of it: they give their shells, and tell how far the handle reaches
  /// @param stamp  s, of the cloud
  /// @param smoothing_time  s, of TrackingConfig. While there are few clouds, all of them have the same weight
  void update(const GraspHandle& found, const std::vector<const GraspHandle*>& pieces, double stamp,
              double smoothing_time);

  /// Says that it was not found in the cloud of this stamp (s).
  void miss(double stamp);

  /// The average, with `hits` and `unseen_for`. The caller sets the id.
  const GraspHandle& handle() const { return handle_; }
  GraspHandle& handle() { return handle_; }

  /// The shape of the average, and the shape that was found last. They differ for a handle that moves.
  const HandleShape& known() const { return known_; }
  const HandleShape& last() const { return last_; }

  double lastSeen() const { return last_seen_; }  ///< s, a stamp

private:
  void average(const GraspHandle& found, const std::vector<const GraspHandle*>& pieces, double weight);
  AxisCurve averagedCurve(const AxisCurve& found, const std::vector<const GraspHandle*>& pieces, double weight) const;
  AxisCurve averagedBlob(const GraspHandle& found, double weight);
  void setCurve(const AxisCurve& curve);

  GraspHandle handle_;
  HandleShape known_;
  HandleShape last_;
  Eigen::Matrix3d axis_scatter_;  // mean of a a^T over the axes a, so that their signs do not matter
  double bent_share_;             // of the clouds in which it was bent
  double last_seen_;
};

}  // namespace grasp_affordances
