#pragma once

#include "grasp_affordances/cloud.h"

#include "simulation/camera_orbit.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "support/scenes.h"

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace grasp_affordances::test
{

/// The scene `table`.
inline const Cloud& table()
{
  static const Cloud cloud = captureScene("table", 1).cloud;
  return cloud;
}

/// The scene `table` from two sides, in its own frame.
struct TableViews
{
  TableViews()
  {
    const View view = makeScene("table", 1);
    for (const double turn : {0.0, M_PI / 2}) {
      const View turned = viewFromAside(view, turn);
      clouds.push_back(DepthCamera().capture(turned.scene, turned.T_scene_camera, 1 + clouds.size()).cloud);
      poses.push_back(turned.T_scene_camera);
    }
  }

  std::vector<PosedCloud> posed() const { return {{&clouds[0], poses[0]}, {&clouds[1], poses[1]}}; }

  std::vector<Cloud> clouds;
  std::vector<Eigen::Isometry3d> poses;
};

inline const TableViews& tableFromTwoSides()
{
  static const TableViews views;
  return views;
}

}  // namespace grasp_affordances::test
