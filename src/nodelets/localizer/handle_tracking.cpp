#include "nodelets/localizer/handle_tracking.h"

#include <utility>

namespace grasp_affordances
{

const std::vector<GraspHandle>& HandleTracking::update(const std::vector<GraspHandle>& found,
                                                       const TrackingConfig& config, const std_msgs::Header& header,
                                                       CloudClock::Arrival arrival, const FixedFrame& fixed_frame)
{
  const CloudClock::Reading now = clock_.read(header.stamp, arrival);
  const std::string& frame = fixed_frame.name.empty() ? header.frame_id : fixed_frame.name;
  frame_before_ = config.track && !now.began_anew && frame != frame_ ? frame_ : "";
  if (now.began_anew || frame != frame_) {
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
  handles_ = tracker_.update(handles_, now.time);
  const Eigen::Isometry3d T_output_fixed = fixed_frame.T_fixed_output.inverse();
  for (GraspHandle& handle : handles_) {
    handle = transformed(std::move(handle), T_output_fixed);
  }
  return handles_;
}

}  // namespace grasp_affordances
