#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include <memory>
#include <vector>

namespace grasp_affordances
{

/// Gives handles the same id from cloud to cloud, and smooths them. Deterministic; of one thread.
///
/// A handle that is found again within the limits of TrackingConfig of where it is known to be keeps its id, also where
/// it is found shorter or in several pieces. One that is new gets the next id, and is reported once it was found in
/// `min_hits` clouds; those of the first cloud, of the first one after reset() or after a gap in time longer than
/// `lifetime`, are reported at once: a single cloud gives handles. A handle that is not found keeps its last state,
/// with `unseen_for` and without shells, until `lifetime` has passed; where it comes back within five lifetimes it has
/// its id again. Pieces that stay apart for longer than that are handles of their own.
///
/// Without TrackingConfig::track handles pass through as they are, ids and all.
class HandleTracker
{
public:
  explicit HandleTracker(const TrackingConfig& config = TrackingConfig());
  ~HandleTracker();
  HandleTracker(HandleTracker&&) noexcept;
  HandleTracker& operator=(HandleTracker&&) noexcept;

  /// Changes the parameters; what is tracked stays, unless nothing is tracked any more.
  void configure(const TrackingConfig& config);

  /// The handles that are known after a cloud, by id, in the frame of `found`. They remain valid until the next call.
  /// @param found  in a frame in which handles stand still
  /// @param stamp  s, of the cloud, of any epoch. An earlier one than the last begins anew, as after reset(). Clouds
  /// with the same one are averaged
  const std::vector<GraspHandle>& update(const std::vector<GraspHandle>& found, double stamp);

  /// Forgets all handles. Ids are not used again.
  void reset();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace grasp_affordances
