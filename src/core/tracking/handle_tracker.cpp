#include "grasp_affordances/handle_tracker.h"

#include "core/tracking/assignment.h"
#include "core/tracking/handle_likeness.h"
#include "core/tracking/tracked_handle.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kAnother = 1.0;  // unlikeness of another handle
constexpr double kMemory = 5.0;   // lifetimes for which the id of a reported handle is kept

struct Track
{
  TrackedHandle handle;
  bool reported;
  double last_whole;  // s, stamp of the last cloud in which it was not in pieces
};

}  // namespace

class HandleTracker::Implementation
{
public:
  explicit Implementation(const TrackingConfig& config) : config_(config) {}

  void configure(const TrackingConfig& config)
  {
    config_ = config;
    if (!config_.track) {
      reset();
    }
  }

  void reset()
  {
    tracks_.clear();
    last_stamp_.reset();
  }

  const std::vector<GraspHandle>& update(const std::vector<GraspHandle>& found, double stamp)
  {
    if (!config_.track) {
      known_ = found;
      return known_;
    }
    if (last_stamp_ && stamp < *last_stamp_) {
      reset();
    }
    const bool report_at_once = !last_stamp_ || stamp - *last_stamp_ > config_.lifetime;
    last_stamp_ = stamp;
    track(found, stamp, report_at_once);
    report();
    return known_;
  }

private:
  void track(const std::vector<GraspHandle>& found, double stamp, bool report_at_once)
  {
    const std::vector<HandleShape> shapes(found.begin(), found.end());
    const std::vector<std::optional<Eigen::Index>> matches = associate(shapes);
    std::vector<bool> explained(found.size(), false);
    for (const std::optional<Eigen::Index>& match : matches) {
      if (match) {
        explained[*match] = true;
      }
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      Track& track = tracks_[i];
      if (!matches[i]) {
        track.handle.miss(stamp);
        track.last_whole = stamp;
        continue;
      }
      const std::vector<const GraspHandle*> pieces = takePieces(track, found, shapes, stamp, explained);
      track.handle.update(found[*matches[i]], pieces, stamp, config_.smoothing_time);
      track.reported |= report_at_once || track.handle.handle().hits >= static_cast<std::uint32_t>(config_.min_hits);
    }
    forget();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!explained[i]) {
        begin(found[i], stamp, report_at_once);
      }
    }
  }

  std::vector<std::optional<Eigen::Index>> associate(const std::vector<HandleShape>& found) const
  {
    Eigen::MatrixXd costs(static_cast<Eigen::Index>(tracks_.size()), static_cast<Eigen::Index>(found.size()));
    for (Eigen::Index i = 0; i < costs.rows(); ++i) {
      const TrackedHandle& handle = tracks_[static_cast<std::size_t>(i)].handle;
      for (Eigen::Index j = 0; j < costs.cols(); ++j) {
        const HandleShape& shape = found[static_cast<std::size_t>(j)];
        costs(i, j) = std::min(unlikeness(handle.known(), shape, config_), unlikeness(handle.last(), shape, config_));
      }
    }
    return cheapestAssignment(costs, kAnother);
  }

  /// The handles that were found where a tracked one is known to be, besides the one that was matched with it. They are
  /// pieces of it, unless it has been in pieces for longer than the lifetime. Marks the pieces as explained.
  std::vector<const GraspHandle*> takePieces(Track& track, const std::vector<GraspHandle>& found,
                                             const std::vector<HandleShape>& shapes, double stamp,
                                             std::vector<bool>& explained) const
  {
    std::vector<const GraspHandle*> pieces;
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!explained[i] && isPiece(shapes[i], track.handle.known(), config_)) {
        pieces.push_back(&found[i]);
        taken.push_back(i);
      }
    }
    if (pieces.empty()) {
      track.last_whole = stamp;
    } else if (stamp - track.last_whole > config_.lifetime) {
      return {};
    }
    for (const std::size_t i : taken) {
      explained[i] = true;
    }
    return pieces;
  }

  void forget()
  {
    const auto gone = [&](const Track& track) {
      return track.handle.handle().unseen_for > (track.reported ? kMemory : 1.0) * config_.lifetime;
    };
    tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), gone), tracks_.end());
  }

  void begin(const GraspHandle& found, double stamp, bool report_at_once)
  {
    tracks_.push_back({TrackedHandle(found, stamp), report_at_once || config_.min_hits <= 1, stamp});
    tracks_.back().handle.handle().id = next_id_++;
  }

  void report()
  {
    known_.clear();
    for (const Track& track : tracks_) {
      if (track.reported && track.handle.handle().unseen_for <= config_.lifetime) {
        known_.push_back(track.handle.handle());
      }
    }
  }

  TrackingConfig config_;
  std::vector<Track> tracks_;  // by id
  std::vector<GraspHandle> known_;
  std::optional<double> last_stamp_;
  std::uint32_t next_id_ = 1;
};

HandleTracker::HandleTracker(const TrackingConfig& config) : implementation_(std::make_unique<Implementation>(config))
{
}

HandleTracker::~HandleTracker() = default;
HandleTracker::HandleTracker(HandleTracker&&) noexcept = default;
HandleTracker& HandleTracker::operator=(HandleTracker&&) noexcept = default;

void HandleTracker::configure(const TrackingConfig& config)
{
  implementation_->configure(config);
}

const std::vector<GraspHandle>& HandleTracker::update(const std::vector<GraspHandle>& found, double stamp)
{
  return implementation_->update(found, stamp);
}

void HandleTracker::reset()
{
  implementation_->reset();
}

}  // namespace grasp_affordances
