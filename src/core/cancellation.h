#pragma once

#include "grasp_affordances/localizer.h"

#include <functional>
#include <utility>

namespace grasp_affordances
{

/// Whether a localization is wanted to end early: see Localizer::cancelWhen(). Every method may be called from any
/// thread.
class Cancellation
{
public:
  Cancellation() = default;  ///< nobody ever wants it
  explicit Cancellation(std::function<bool()> wanted) : wanted_(std::move(wanted)) {}

  bool wanted() const { return wanted_ && wanted_(); }

  /// @throw Cancelled where it is wanted. Not for the tasks of a ThreadTeam: those return, and their caller checks.
  void check() const
  {
    if (wanted()) {
      throw Cancelled();
    }
  }

private:
  std::function<bool()> wanted_;
};

}  // namespace grasp_affordances
