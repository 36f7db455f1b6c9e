#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace grasp_affordances
{

/// Converts the times of frames from the device's clock to the host's clock.
///
/// A device stamps frames with its own clock. That clock starts at an arbitrary time and drifts by tens of ppm. The
/// host sees only when a frame arrives: the frame's true time plus a delay. The delay is never negative and is small
/// for most frames. The offset between the clocks is therefore estimated as the smallest difference between arrival
/// time and device time in the last five seconds. A frame that the bus or the scheduler delays does not change this
/// estimate. Drift adds an error of at most 5 us per ppm.
///
/// The returned times increase strictly, by at least one nanosecond. They are never later than the arrival, except
/// where two arrivals are less than a nanosecond apart. A new estimate starts when the device's clock goes back, as
/// when a recording starts again, or stands still. If the host's clock is set back, the returned times go back, too.
/// Not safe to use from several threads.
class DeviceClock
{
public:
  /// @param device_us time of the frame by the device's clock, microseconds
  /// @param arrival_ns time of its arrival by the host's clock, nanoseconds
  /// @return time of the frame by the host's clock, nanoseconds
  std::int64_t hostTime(std::uint64_t device_us, std::int64_t arrival_ns);

  /// Starts a new estimate. Call it when no frames were read for a while: a recording's clock stops meanwhile.
  void restart() { offsets_.clear(); }

private:
  struct Offset
  {
    std::int64_t device_ns;  // device time at which it was measured
    std::int64_t offset_ns;  // arrival minus device time
  };

  std::deque<Offset> offsets_;  // candidates for the smallest in the window; the first is the oldest and the smallest
  std::optional<std::int64_t> last_device_ns_;
  std::optional<std::int64_t> last_arrival_ns_;
  std::optional<std::int64_t> last_host_ns_;
};

}  // namespace grasp_affordances
