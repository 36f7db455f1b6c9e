#pragma once

#include <chrono>

namespace grasp_affordances
{

/// Lets what is said again and again through once per period of wall-clock time: ROS time may stand still or go back.
/// Of one thread.
class Throttle
{
public:
  /// Whether it is time to say it; then not again for a period.
  bool due()
  {
    const Clock::time_point now = Clock::now();
    if (now < next_) {
      return false;
    }
    next_ = now + kPeriod;
    return true;
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPeriod{5};

  Clock::time_point next_ = Clock::time_point::min();
};

}  // namespace grasp_affordances
