#include "grasp_affordances/handle_tracker.h"

namespace grasp_affordances
{

HandleTracker::HandleTracker(const TrackingConfig& config) : config_(config) {}

void HandleTracker::configure(const TrackingConfig& config)
{
  config_ = config;
}

const std::vector<GraspHandle>& HandleTracker::update(const std::vector<GraspHandle>& found, double /*stamp*/)
{
  known_ = found;
  return known_;
}

void HandleTracker::reset()
{
  known_.clear();
}

}  // namespace grasp_affordances
