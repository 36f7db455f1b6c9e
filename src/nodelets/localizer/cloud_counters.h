#pragma once

#include "grasp_affordances/LocalizationStatistics.h"

#include <cstdint>
#include <functional>
#include <mutex>

namespace grasp_affordances
{

/// What became of the clouds of a node. The clouds of one moment count as one, however many cameras there are.
class CloudCounters
{
public:
  /// Counts a cloud that came in and hands it over to the worker; `hand_over` returns whether another cloud, which
  /// waited, was dropped for it. From any thread.
  void receive(const std::function<bool()>& hand_over)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++received_;
    dropped_ += hand_over() ? 1 : 0;
  }

  /// Counts a cloud that came in and is left out, for the rate or because nobody asked for it. From any thread.
  void leaveOut()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++received_;
    ++left_out_;
  }

  // The following come from one thread: the worker's.

  void process() { ++processed_; }
  void reject() { ++rejected_; }
  void leaveUntransformed() { ++untransformed_; }

  /// Writes the counters into a message.
  void report(LocalizationStatistics& message)
  {
    message.clouds_processed = processed_;
    message.clouds_rejected = rejected_;
    message.clouds_without_transform = untransformed_;
    const std::lock_guard<std::mutex> lock(mutex_);
    message.clouds_dropped = dropped_;
    message.clouds_left_out = left_out_;
    message.clouds_received = received_;
  }

private:
  std::mutex mutex_;  // guards the following three, which are read and written together
  std::uint64_t received_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t left_out_ = 0;

  // Of the worker's thread.
  std::uint64_t processed_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t untransformed_ = 0;
};

}  // namespace grasp_affordances
