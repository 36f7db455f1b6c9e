#pragma once

#include "simulation/ground_truth.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{

/// A measurement with the label of every pixel.
struct LabelledFrame : Frame
{
  std::vector<std::uint32_t> labels;  ///< 0: not graspable, 1..: affordance, 255: doubtful
};

inline LabelledFrame captureView(const View& view, std::uint64_t seed, const SensorModel& model = SensorModel())
{
  Frame frame = DepthCamera(model).capture(view.scene, view.T_scene_camera, seed);
  std::vector<std::uint32_t> labels = groundTruth(view, frame, model).labels;
  return {std::move(frame), std::move(labels)};
}

/// A scene of the library as the virtual Xtion measures it.
inline LabelledFrame captureScene(const std::string& name, std::uint64_t seed, const SensorModel& model = SensorModel())
{
  return captureView(makeScene(name, seed), seed, model);
}

/// The scene `shadow` or `shadow_removed` by a camera so turned that its projector, too, sees the strip all along.
inline LabelledFrame captureStrip(const std::string& name, std::uint64_t seed)
{
  View view = makeScene(name, seed);
  view.T_scene_camera = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ());
  return captureView(view, seed);
}

}  // namespace grasp_affordances::test
