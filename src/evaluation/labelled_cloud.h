#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/ground_truth.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A cloud with what can be grasped in it.
struct LabelledCloud
{
  Cloud cloud;
  std::vector<std::uint32_t> labels;    ///< per point: 0 not graspable, 1.. affordance, 255 doubtful
  std::vector<Affordance> affordances;  ///< what is not known of one is NaN or empty
  double capture_radius = 0.0;          ///< m, of the hand that the labels hold for
};

/// One cloud of an evaluation.
struct EvaluationFrame
{
  std::string group;  ///< of the scenes whose results are also pooled; empty: of none
  std::string scene;
  std::uint64_t seed = 0;               ///< of a rendered scene
  std::function<LabelledCloud()> load;  ///< the same each time; safe to call from several threads
};

/// A scene of the library as the virtual Xtion sees it, with its ground truth; scene and noise have the same seed.
/// Loading it throws std::runtime_error for a name that is not in the library.
EvaluationFrame renderedFrame(const std::string& group, const std::string& scene, std::uint64_t seed,
                              const GraspDefinition& definition);

}  // namespace grasp_affordances
