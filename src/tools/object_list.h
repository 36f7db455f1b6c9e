#pragma once

#include "simulation/ground_truth.h"
#include "simulation/scene.h"
#include "simulation/sensor.h"

#include <cstdint>
#include <string>

namespace grasp_affordances
{

/// What a rendered scene holds, as JSON: scene, seed, the camera (width and height in pixels, intrinsics, position and
/// orientation quaternion x, y, z, w of its optical frame in the scene), the definition of an affordance, the objects
/// by name in the order in which they were made, and the affordances with the fields of `Affordance`. Lengths in
/// metres, in the scene's frame.
std::string objectList(const std::string& scene, std::uint64_t seed, const View& view, const SensorModel& model,
                       const GraspDefinition& definition, const GroundTruth& truth);

/// A line of text per affordance.
std::string affordanceTable(const GroundTruth& truth);

}  // namespace grasp_affordances
