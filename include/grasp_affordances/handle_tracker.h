#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include <memory>
#include <vector>

namespace grasp_affordances
{

/// Gives handles the same id from cloud to cloud, and smooths them. Deterministic. An instance serves one thread at a
/// time.
///
/// **Ids.** A handle keeps its id where it is found again within the limits of TrackingConfig, even if it is found
/// shorter or in several pieces. A new handle gets the next id.
///
/// **Reports.** A new handle is reported once it was found in `min_hits` clouds. The handles of some clouds are
/// reported at once, so that a single cloud gives handles: those of the first cloud, of the first cloud after reset(),
/// and of the first cloud after a gap in time longer than `lifetime`.
///
/// **Handles that are not found.** Such a handle is reported in its last state, without shells, and `unseen_for` says
/// for how long. After `lifetime` it is no longer reported. If it comes back within five lifetimes, it has its id
/// again.
///
/// **Pieces.** A handle that is found in pieces for longer than `lifetime` is several handles from then on.
///
/// Without TrackingConfig::track, handles are returned as they are, with their ids.
class HandleTracker
{
public:
  explicit HandleTracker(const TrackingConfig& config = TrackingConfig());
  ~HandleTracker();
  HandleTracker(HandleTracker&&) noexcept;
  HandleTracker& operator=(HandleTracker&&) noexcept;

  /// Changes the parameters. Tracked handles stay; with TrackingConfig::track off they are forgotten, as by reset().
  void configure(const TrackingConfig& config);

  /// Takes in the handles of a cloud, and returns the handles that are known then, in the order of their ids. The
  /// result is in the frame of `found`, and valid until the next call.
  /// @param found  in a frame in which handles stand still, such as that of the room
  /// @param stamp  s, of the cloud, since any epoch. A stamp earlier than the last one starts anew, as reset() does.
  /// Clouds with the same stamp are averaged
  const std::vector<GraspHandle>& update(const std::vector<GraspHandle>& found, double stamp);

  /// Forgets all handles. Their ids are not used again.
  void reset();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace grasp_affordances
