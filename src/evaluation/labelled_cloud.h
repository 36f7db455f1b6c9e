#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/background.h"
#include "simulation/ground_truth.h"
#include "simulation/sensor_model.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What another camera sees of the same scene.
struct FurtherView
{
  Cloud cloud;
  Eigen::Isometry3d T_first_this = Eigen::Isometry3d::Identity();  ///< from its frame to that of the first view
  std::vector<std::uint32_t> labels;                               ///< per point, those of the first view
};

/// A cloud with what can be grasped in it, and perhaps more views of that.
struct LabelledCloud
{
  Cloud cloud;
  std::vector<std::uint32_t> labels;    ///< per point: 0 not graspable, 1.. affordance, 255 doubtful
  std::vector<Affordance> affordances;  ///< in the cloud's frame; what is not known of one is NaN or empty
  double capture_radius = 0.0;          ///< m, of the hand that the labels hold for
  std::vector<FurtherView> further_views;
  std::vector<std::uint32_t> objects;     ///< per point, index into their names; empty where it is not known
  std::vector<std::string> object_names;  ///< of the scene's; the last one is empty, of points on none
};

/// The first so many views as one, unorganized, in the frame of the first.
LabelledCloud united(const LabelledCloud& labelled, std::size_t views);

/// One cloud of an evaluation.
struct EvaluationFrame
{
  std::string group;  ///< of the scenes whose results are also pooled; empty: of none
  std::string scene;
  std::uint64_t seed = 0;               ///< of a rendered scene
  std::function<LabelledCloud()> load;  ///< the same each time; safe to call from several threads
};

/// A scene of the library as a sensor sees it, with its ground truth; scene, background and noise have the same seed.
/// Loading it throws std::runtime_error for a name that is not in the library.
/// @param turns  rad; one view for each, see viewFromAside(), with noise of its own; at least one
EvaluationFrame renderedFrame(const std::string& group, const std::string& scene, std::uint64_t seed,
                              const GraspDefinition& definition, const std::vector<double>& turns = {0.0},
                              const SensorModel& sensor = SensorModel(), Background background = Background::walls);

}  // namespace grasp_affordances
