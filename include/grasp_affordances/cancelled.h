#pragma once

#include <stdexcept>

namespace grasp_affordances
{

/// Thrown by Localizer::localize() where the function that was given to Localizer::cancelWhen() returned true.
class Cancelled : public std::runtime_error
{
public:
  Cancelled() : std::runtime_error("the localization was cancelled") {}
};

}  // namespace grasp_affordances
