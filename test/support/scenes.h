#pragma once

#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <cstdint>
#include <string>

namespace grasp_affordances::test
{

/// A scene of the library as the virtual Xtion measures it.
inline Frame captureScene(const std::string& name, std::uint64_t seed, const XtionModel& model = XtionModel())
{
  const View view = makeScene(name, seed);
  return Xtion(model).capture(view.scene, view.T_scene_camera, seed);
}

}  // namespace grasp_affordances::test
