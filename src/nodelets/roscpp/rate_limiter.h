#pragma once

#include <algorithm>
#include <cstdint>

namespace grasp_affordances
{

/// Thins out a sequence of stamps to a rate that is not exceeded on average. Not safe to use from several threads.
class RateLimiter
{
public:
  /// @param max_rate Hz; 0: everything passes
  explicit RateLimiter(double max_rate)
      : period_ns_(max_rate > 0.0 ? static_cast<std::int64_t>(std::min(1e9 / max_rate, kLongest)) : 0)
  {
  }

  /// Whether what has this stamp, in ns, passes. Stamps that go back begin a new sequence.
  bool passes(std::int64_t stamp_ns)
  {
    if (stamp_ns < due_ns_ && stamp_ns >= due_ns_ - period_ns_) {
      return false;
    }
    // Late by less than a period: the next one stays due when it was, so that the rate is kept on average.
    const bool in_sequence = stamp_ns >= due_ns_ && stamp_ns < due_ns_ + period_ns_;
    due_ns_ = (in_sequence ? due_ns_ : stamp_ns) + period_ns_;
    return true;
  }

private:
  static constexpr double kLongest = 1e18;  // ns

  std::int64_t period_ns_;
  std::int64_t due_ns_ = 0;
};

}  // namespace grasp_affordances
