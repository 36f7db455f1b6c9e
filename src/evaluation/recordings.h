#pragma once

#include "evaluation/labelled_cloud.h"

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The recorded clouds that a file of labels describes, in the order of their names:
///
///     {"capture_radius": 0.048, "scenes": {"NAME": {"affordances": [[20], [30, 31]], "ignore": [50]}, ...}}
///
/// NAME.pcd lies beside the file, and its field `label` (one UINT32 per point) says which object a point is on. Each
/// list of such labels is one affordance, numbered from 1 in the order of the lists; what is on an ignored object is
/// doubtful, everything else not graspable. A missing PCD file is noticed when the frame is loaded.
///
/// @param set  what the frames' group is named, and their scenes "SET.NAME"; empty: "recorded" and NAME
/// @throw std::runtime_error, with path and reason, for a file that cannot be read or is not as above.
std::vector<EvaluationFrame> recordedFrames(const std::string& labels_file, const std::string& set = "");

/// The capture radius (m) of a file of labels. @throw std::runtime_error as recordedFrames()
double recordedCaptureRadius(const std::string& labels_file);

/// Names of sets of labels, by their files: of data/labels-026.json it is "data.labels-026".
/// @throw std::runtime_error for two of one name
std::vector<std::string> recordedSets(const std::vector<std::string>& labels_files);

/// The frames of several files. One file has no set; of several, each has its own.
/// @throw std::runtime_error as these
std::vector<EvaluationFrame> recordedFrames(const std::vector<std::string>& labels_files);

}  // namespace grasp_affordances
