#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// When clouds arrive on a topic, and whether the next one is overdue. Cameras that are triggered, or limited in their
/// rate, send less than one in five seconds. Of one thread.
class CloudPace
{
public:
  using Time = std::chrono::steady_clock::time_point;

  /// Waits for clouds from now on. What is known of their pace stays.
  void begin(Time now)
  {
    last_ = now;
    arrivals_ = 0;
  }

  /// A cloud has arrived.
  void arrive(Time now)
  {
    if (arrivals_ > 0) {
      intervals_[next_] = seconds(now - last_);
      next_ = (next_ + 1) % intervals_.size();
    }
    last_ = now;
    ++arrivals_;
  }

  /// How many clouds have arrived since begin().
  std::uint64_t arrivals() const { return arrivals_; }

  /// s since the last cloud, or begin() where there was none since.
  double waited(Time now) const { return seconds(now - last_); }

  /// s without a cloud after which the next one is overdue: 5, or three times the longest of the last ten intervals.
  /// Three: two clouds in succession may be lost.
  double patience() const
  {
    return std::max(kShortestPatience, 3.0 * *std::max_element(intervals_.begin(), intervals_.end()));
  }

  bool isOverdue(Time now) const { return waited(now) >= patience(); }

private:
  static constexpr double kShortestPatience = 5.0;  // s

  static double seconds(std::chrono::steady_clock::duration duration)
  {
    return std::chrono::duration<double>(duration).count();
  }

  Time last_;
  std::uint64_t arrivals_ = 0;
  std::array<double, 10> intervals_{};  // s, the last ones
  std::size_t next_ = 0;                // of them to be replaced
};

}  // namespace grasp_affordances
