#pragma once

#include "core/tracking/handle_likeness.h"
#include "grasp_affordances/handle.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// A handle that was found in one or several clouds, averaged over them, in a frame in which it stands still.
class TrackedHandle
{
public:
  TrackedHandle(const GraspHandle& found, double stamp);

  /// @param found  it, in a cloud
  /// @param pieces  more of it, where it was found in several pieces: they only tell how far it reaches, and have
  /// shells
  /// @param smoothing_time  s, of TrackingConfig; the average of so few clouds that they are newer is the plain one
  void update(const GraspHandle& found, const std::vector<const GraspHandle*>& pieces, double stamp,
              double smoothing_time);

  /// It was not found in the cloud of that stamp.
  void miss(double stamp);

  /// As it is known, with `hits` and `unseen_for`; its id is the caller's business.
  const GraspHandle& handle() const { return handle_; }
  GraspHandle& handle() { return handle_; }

  /// As it is known, and as it was found last, which differs where it moves.
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
  Eigen::Matrix3d axis_scatter_;  ///< mean of a a': the mean of axes without regard to their signs
  double bent_share_;             ///< of clouds in which it was bent
  double last_seen_;
};

}  // namespace grasp_affordances
