#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Gives handles the same id from cloud to cloud, and smooths them. Deterministic; of one thread.
class HandleTracker
{
public:
  explicit HandleTracker(const TrackingConfig& config = TrackingConfig());

  /// Changes the parameters; what is tracked stays.
  void configure(const TrackingConfig& config);

  /// The handles that are known after a cloud, by id, in the frame of `found`.
  /// @param found  in a frame in which handles stand still
  /// @param stamp  s, of the cloud
  const std::vector<GraspHandle>& update(const std::vector<GraspHandle>& found, double stamp);

  /// Forgets all handles. Ids are not used again.
  void reset();

private:
  TrackingConfig config_;
  std::vector<GraspHandle> known_;
  std::uint32_t next_id_ = 1;
};

}  // namespace grasp_affordances
