#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace grasp_affordances
{

/// Tells when, by the host's clock, a device took its frames.
///
/// A device stamps frames with a clock of its own, that began at an arbitrary time and goes wrong by tens of ppm. What
/// the host sees of it are arrivals: the frame's true time plus a delay that is never negative, and small for most
/// frames. The offset between the clocks is therefore the smallest difference between arrival and device time of the
/// last seconds: a frame that the bus or the scheduler held up does not move it, and drift stays below 5 us per ppm.
///
/// The times told grow strictly, by at least a nanosecond, and are never later than the arrival, unless arrivals are
/// that close together. A device clock that goes back, as where a recording begins again, or stands still starts a new
/// estimate. Where the host's own clock is set back, the times follow it. Not safe to use from several threads.
class DeviceClock
{
public:
  /// @param device_us the frame's time by the device, microseconds
  /// @param arrival_ns when it arrived, by the host, nanoseconds
  /// @return the frame's time by the host, nanoseconds
  std::int64_t hostTime(std::uint64_t device_us, std::int64_t arrival_ns);

  /// Starts a new estimate, as is due where no frames were taken for a while: that of a recording stands meanwhile.
  void restart() { offsets_.clear(); }

private:
  struct Offset
  {
    std::int64_t device_ns;  // when it was seen
    std::int64_t offset_ns;  // arrival minus device time
  };

  std::deque<Offset> offsets_;  // those of the window that may become the smallest, oldest and smallest first
  std::optional<std::int64_t> last_device_ns_;
  std::optional<std::int64_t> last_arrival_ns_;
  std::optional<std::int64_t> last_host_ns_;
};

}  // namespace grasp_affordances
