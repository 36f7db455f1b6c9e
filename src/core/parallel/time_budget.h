#pragma once

#include <chrono>
#include <optional>

namespace grasp_affordances
{

/// Limits the wall time that a cloud may take, counted from construction. Without a limit no clock is read. Every
/// method may be called from any thread.
class TimeBudget
{
public:
  /// @param milliseconds  0: no limit
  explicit TimeBudget(double milliseconds)
  {
    if (milliseconds > 0.0) {
      end_ = Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(milliseconds));
    }
  }

  bool spent() const { return end_ && Clock::now() >= *end_; }

private:
  using Clock = std::chrono::steady_clock;

  std::optional<Clock::time_point> end_;
};

}  // namespace grasp_affordances
