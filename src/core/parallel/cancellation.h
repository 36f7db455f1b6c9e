#pragma once

#include "grasp_affordances/cancelled.h"

#include <atomic>
#include <functional>
#include <utility>

namespace grasp_affordances
{

/// Tells whether a localization is to end early, see Localizer::cancelWhen(). Once the answer was yes it stays yes
/// until begin(): a part of the work that ended early is not finished, and the parts after it must not use its result.
/// wanted() and check() may be called from any thread.
class Cancellation
{
public:
  Cancellation() = default;  ///< never wanted
  explicit Cancellation(std::function<bool()> wanted) : wanted_(std::move(wanted)) {}

  /// Asks another function from now on.
  void askInstead(std::function<bool()> wanted) { wanted_ = std::move(wanted); }

  /// Forgets the answer of the localization before.
  void begin() { heard_ = false; }

  bool wanted() const
  {
    if (!heard_ && wanted_ && wanted_()) {
      heard_ = true;
    }
    return heard_;
  }

  /// @throw Cancelled where it is wanted. Tasks of a ThreadTeam must not call this: they return early where it is
  /// wanted(), and their caller checks.
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
