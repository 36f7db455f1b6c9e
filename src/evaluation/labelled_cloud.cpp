#include "evaluation/labelled_cloud.h"

#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <exception>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

LabelledCloud render(const std::string& scene, std::uint64_t seed, const GraspDefinition& definition)
{
  const View view = makeScene(scene, seed);
  const Xtion xtion;
  Frame frame = xtion.capture(view.scene, view.T_scene_camera, seed);
  GroundTruth truth = groundTruth(view, frame, xtion.model(), definition);
  return {std::move(frame.cloud), std::move(truth.labels), std::move(truth.affordances), definition.capture_radius};
}

}  // namespace

EvaluationFrame renderedFrame(const std::string& group, const std::string& scene, std::uint64_t seed,
                              const GraspDefinition& definition)
{
  const auto load = [scene, seed, definition] {
    try {
      return render(scene, seed, definition);
    } catch (const std::exception& error) {
      throw std::runtime_error(scene + ", seed " + std::to_string(seed) + ": " + error.what());
    }
  };
  return {group, scene, seed, load};
}

}  // namespace grasp_affordances
