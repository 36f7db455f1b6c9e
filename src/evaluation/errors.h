#pragma once

#include "evaluation/summary.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// A place with wrong shells or handles, or an affordance that was missed or is not one handle, in one frame under one
/// variation.
struct Error
{
  enum Kind
  {
    wrong_shell,
    miss,  ///< no right shell
    wrong_handle,
    no_handle,       ///< right shells, but no right handle
    several_handles  ///< more than one right handle
  };
  Kind kind = wrong_shell;
  std::size_t frame = 0;      ///< index
  std::size_t variation = 0;  ///< index
  std::size_t run = 0;        ///< index of the first one with it
  std::size_t count = 0;      ///< wrong shells or handles there, or runs with that affordance in error
  std::size_t index = 0;      ///< in the run of the wrong shell or handle
  std::uint32_t label = 0;    ///< of the affordance in error
};

/// The errors most worth a look: per scene, variation and kind at most `limit`, those with most wrong shells or handles
/// at a place, and the affordances with most visible points. Wrong ones are at one place where their centroids are less
/// than the capture radius apart.
std::vector<Error> worstErrors(const Evaluation& evaluation, std::size_t limit);

/// Whether a run has that error of an affordance; false for the kinds that are of no affordance.
bool isInError(const Run& run, Error::Kind kind, std::uint32_t label);

/// Of the affordance in error.
std::size_t affordanceIndex(const FrameResult& frame, const Error& error);

}  // namespace grasp_affordances
