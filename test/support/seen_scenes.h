#pragma once

#include "grasp_affordances/localizer.h"
#include "simulation/camera_orbit.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace grasp_affordances::test
{

inline Localization localizeViews(const Config& config, const std::vector<PosedCloud>& views)
{
  Localization result;
  Localizer(config).localize(views, result);
  return result;
}

/// A scene as several cameras see it, which are turned about its vertical by so many degrees; noise differs.
struct SeenScene
{
  SeenScene(const View& view, const std::vector<double>& turns, const SensorModel& model = SensorModel())
  {
    for (const double turn : turns) {
      const View turned = viewFromAside(view, turn * M_PI / 180.0);
      frames.push_back(DepthCamera(model).capture(turned.scene, turned.T_scene_camera, 1 + frames.size()));
      T_scene_camera.push_back(turned.T_scene_camera);
    }
  }

  /// The first `count` views in the frame of the scene.
  std::vector<PosedCloud> views(std::size_t count) const
  {
    std::vector<PosedCloud> result;
    for (std::size_t i = 0; i < count; ++i) {
      result.push_back({&frames[i].cloud, T_scene_camera[i]});
    }
    return result;
  }

  std::vector<Frame> frames;
  std::vector<Eigen::Isometry3d> T_scene_camera;
};

inline double quantile(std::vector<double> values, double share)
{
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size())));
}

}  // namespace grasp_affordances::test
