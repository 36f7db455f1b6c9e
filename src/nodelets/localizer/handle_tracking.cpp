#include "nodelets/localizer/handle_tracking.h"

#include <chrono>
#include <utility>

namespace grasp_affordances
{
namespace
{

/// s; a cloud without a stamp has the time at which it is dealt with.
double secondsOf(const ros::Time& stamp)
{
  if (!stamp.isZero()) {
    return stamp.toSec();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

const std::vector<GraspHandle>& HandleTracking::update(const std::vector<GraspHandle>& found,
                                                       const TrackingConfig& config, const std_msgs::Header& header,
                                                       const FixedFrame& fixed_frame)
{
  const std::string& frame = fixed_frame.name.empty() ? header.frame_id : fixed_frame.name;
  if (frame != frame_) {
    tracker_.reset();
    frame_ = frame;
  }
  tracker_.configure(config);
  handles_ = found;
  if (!config.track) {  // untouched by a transform there and back
    return handles_;
  }
  for (GraspHandle& handle : handles_) {
    handle = transformed(std::move(handle), fixed_frame.T_fixed_output);
  }
  handles_ = tracker_.update(handles_, secondsOf(header.stamp));
  const Eigen::Isometry3d T_output_fixed = fixed_frame.T_fixed_output.inverse();
  for (GraspHandle& handle : handles_) {
    handle = transformed(std::move(handle), T_output_fixed);
  }
  return handles_;
}

}  // namespace grasp_affordances
