#pragma once

#include <chrono>
#include <utility>

namespace grasp_affordances
{

/// Measures wall time.
class Stopwatch
{
public:
  /// Milliseconds since construction, or since the last call.
  double lap()
  {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace grasp_affordances
