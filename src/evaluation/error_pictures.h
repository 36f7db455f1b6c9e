#pragma once

#include "evaluation/summary.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A place with wrong shells, or an affordance that was missed, in one frame under one variation.
struct Error
{
  std::size_t frame = 0;      ///< index
  std::size_t variation = 0;  ///< index
  std::size_t run = 0;        ///< index of the first one with it
  std::size_t count = 0;      ///< wrong shells there, or runs that missed it
  bool is_miss = false;
  std::size_t shell = 0;    ///< index in the run of a wrong one
  std::uint32_t label = 0;  ///< of the affordance missed
};

/// The errors most worth a look: per scene and variation at most `limit` places, those with most wrong shells, and as
/// many missed affordances, those with most visible points. Wrong shells are at one place where their centroids are
/// less than the capture radius apart.
std::vector<Error> worstErrors(const Evaluation& evaluation, std::size_t limit);

/// Draws each error with the cloud around it, colored by label: a wrong shell as
/// FOLDER/SCENE-SEED-PRESET-ESTIMATOR-wrong-RUN-SHELL.png with a cross-section beside it in ...-section.png, RUN and
/// SHELL being those of shells.csv; a miss as ...-miss-RUN-LABEL.png, the affordance in magenta. Earlier pictures of
/// errors in the folder are removed. Of several views it draws the points of all, and -N-views follows
/// ESTIMATOR.
///
/// @param frames  that were evaluated
/// @param threads  0: one per core
/// @param done  called after each error, from one thread at a time
/// @throw std::exception for a folder or a picture that cannot be written.
void drawErrors(const std::string& folder, const Evaluation& evaluation, const std::vector<EvaluationFrame>& frames,
                const std::vector<Error>& errors, std::size_t threads, const std::function<void()>& done);

}  // namespace grasp_affordances
