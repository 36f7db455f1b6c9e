#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "grasp_affordances/handle_tracker.h"
#include "nodelets/roscpp/cloud_clock.h"

#include <std_msgs/Header.h>
#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// Where handles stand still, as seen from the outputs at the time of a cloud.
struct FixedFrame
{
  std::string name;  ///< empty: the frame of the outputs
  Eigen::Isometry3d T_fixed_output = Eigen::Isometry3d::Identity();
};

/// Tracks the handles of a node in a fixed frame. It begins anew where time goes back (see CloudClock), and where the
/// frame that handles are tracked in is another one. Of one thread.
class HandleTracking
{
public:
  /// The handles that are known after a cloud, by id, in the frame of the outputs. They remain valid until the next
  /// call.
  /// @param found    in the frame of the header
  /// @param arrival  of the cloud: its time, where its stamp tells none (see CloudClock)
  const std::vector<GraspHandle>& update(const std::vector<GraspHandle>& found, const TrackingConfig& config,
                                         const std_msgs::Header& header, CloudClock::Arrival arrival,
                                         const FixedFrame& fixed_frame);

  /// The frame that handles were tracked in before, where they were forgotten in the last update because it is another
  /// one now; else empty.
  const std::string& frameBefore() const { return frame_before_; }

private:
  CloudClock clock_;
  HandleTracker tracker_;
  std::string frame_;
  std::string frame_before_;
  std::vector<GraspHandle> handles_;
};

}  // namespace grasp_affordances
