#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace grasp_affordances::test
{

/// A way to process a frame whose time is measured.
struct FrameVariant
{
  std::string name;  ///< as "paper/pca/2_threads": a preset, or "textbook", and what differs from it and one thread
  Config config;
  bool textbook = false;  ///< by the textbook pipeline
};

/// The presets by number of samples, capture radius, neighborhood, estimator and threads, and the textbook pipeline.
/// "unfiltered" is without the occlusion filter, so that every sample is fitted.
const std::vector<FrameVariant>& frameVariants();

/// @throw std::out_of_range for a name that is not among them.
const FrameVariant& frameVariant(std::string_view name);

/// Processes the cloud, which is kept, that way; reading and conversion to PCL's own type are done beforehand.
std::function<Localization()> frameRun(const FrameVariant& variant, const Cloud& cloud);

}  // namespace grasp_affordances::test
