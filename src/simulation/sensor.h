#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"
#include "simulation/sensor_model.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// One measurement. Optical frame: x right, y down, z forward. Images are row-major.
struct Frame
{
  Cloud cloud;                       ///< organized, with intrinsics; each point is on its pixel's ray
  std::vector<std::uint16_t> depth;  ///< mm; 0 where nothing was measured (REP 118)
  std::vector<std::int32_t> parts;   ///< index into Scene::parts() of the measured part; -1 if nothing was measured
  std::vector<float> surface_depth;  ///< m, true depth of that part; next to a depth edge it is the depth at a pixel up
                                     ///< to 2 px away along either axis, in a hole that the driver filled the depth at
                                     ///< its end; NaN if nothing was measured
};

/// A simulated depth camera. Safe to use from several threads.
class DepthCamera
{
public:
  /// @throw std::invalid_argument unless picture and window have pixels, the disparity step is positive, and
  /// 0 < min_depth < max_depth <= 65 m.
  explicit DepthCamera(const SensorModel& model = SensorModel());

  /// Captures a frame. It depends on the arguments only, not on the number of threads.
  /// @param T_scene_camera pose of the camera whose image is delivered: of the color camera, if depth is registered to
  /// it
  Frame capture(const Scene& scene, const Eigen::Isometry3d& T_scene_camera, std::uint64_t seed) const;

  const SensorModel& model() const { return model_; }

private:
  SensorModel model_;
};

}  // namespace grasp_affordances
