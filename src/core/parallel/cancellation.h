#pragma once

#include "grasp_affordances/cancelled.h"

#include <atomic>
#include <functional>
#include <utility>

namespace grasp_affordances
{

/// Whether a localization is wanted to end early: see Localizer::cancelWhen(). What has been wanted once stays wanted
/// until begin(): what a part of the work has left undone the rest must not take for done. wanted() and check() may be
/// called from any thread.
class Cancellation
{
public:
  Cancellation() = default;  ///< nobody ever wants it
  explicit Cancellation(std::function<bool()> wanted) : wanted_(std::move(wanted)) {}

  void askInstead(std::function<bool()> wanted) { wanted_ = std::move(wanted); }
  void begin() { heard_ = false; }

  bool wanted() const
  {
    if (!heard_ && wanted_ && wanted_()) {
      heard_ = true;
    }
    return heard_;
  }

  /// @throw Cancelled where it is wanted. Not for the tasks of a ThreadTeam: those return, and their caller checks.
  void check() const
  {
    if (wanted()) {
      throw Cancelled();
    }
  }

private:
  std::function<bool()> wanted_;
  mutable std::atomic<bool> heard_{false};
};

}  // namespace grasp_affordances
