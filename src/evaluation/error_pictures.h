#pragma once

#include "evaluation/errors.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// "wrong", "miss", "wrong-handle", "no-handle" or "several-handles".
const char* errorKindName(Error::Kind kind);

/// Of an error's picture, without .png: see drawErrors().
std::string pictureName(const Evaluation& evaluation, const Error& error);

/// What is written below it: of the error and what it is on.
std::string pictureCaption(const Evaluation& evaluation, const Error& error);

/// Draws each error with the cloud around it, colored by label, as FOLDER/SCENE-SEED-PRESET-ESTIMATOR-KIND-RUN-X.png.
/// KIND is wrong, where X is the SHELL of shells.csv and a cross-section lies beside it in ...-section.png, or
/// wrong-handle, where X is the id of handles.csv; or miss, no-handle (with the right shells) or several-handles (with
/// these), where X is the label of affordances.csv, the affordance in magenta. Of several views it draws the points of
/// all, and -N-views follows ESTIMATOR; where the sampling is varied -N-samples-on or -off does. Earlier pictures of
/// errors in the folder are removed.
///
/// @param frames  that were evaluated
/// @param threads  0: one per core
/// @param done  called after each error, from one thread at a time
/// @throw std::exception for a folder or a picture that cannot be written.
void drawErrors(const std::string& folder, const Evaluation& evaluation, const std::vector<EvaluationFrame>& frames,
                const std::vector<Error>& errors, std::size_t threads, const std::function<void()>& done);

}  // namespace grasp_affordances
