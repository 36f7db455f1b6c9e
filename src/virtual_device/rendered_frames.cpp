#include "virtual_device/rendered_frames.h"

#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor_model.h"
#include "virtual_device/color_image.h"

#include <cmath>

namespace grasp_affordances
{

std::vector<std::uint16_t> registeredDepth(const std::vector<std::uint16_t>& depth, const SensorModel& model)
{
  const auto width = static_cast<int>(model.width);
  const double focal_baseline = 1000.0 * model.intrinsics.fx * kColorBaseline;  // px mm
  std::vector<std::uint16_t> registered(depth.size(), 0);
  for (std::size_t row_start = 0; row_start < depth.size(); row_start += width) {
    for (int column = 0; column < width; ++column) {
      const std::uint16_t millimetres = depth[row_start + column];
      if (millimetres == 0)
        continue;
      const int there = column - static_cast<int>(std::lround(focal_baseline / millimetres));
      if (there < 0)
        continue;
      std::uint16_t& pixel = registered[row_start + there];
      if (pixel == 0 || millimetres < pixel)
        pixel = millimetres;
    }
  }
  return registered;
}

RenderedFrames::RenderedFrames(const VirtualScene& scene)
    : camera_(sensorModel(scene.sensor).unregistered()),  // the device registers depth itself, when it is asked to
      scene_(scene),
      view_(viewFromAside(makeScene(scene.scene, scene.seed), kDegree * scene.turn_deg)),
      frames_(scene.frames),
      thread_([this] { render(); })
{
}

RenderedFrames::~RenderedFrames()
{
  closing_ = true;
  thread_.join();
}

void RenderedFrames::render()
{
  const SensorModel& model = camera_.model();
  View color_view = view_;
  color_view.T_scene_camera.translate(Eigen::Vector3d(kColorBaseline, 0.0, 0.0));
  color_ = colorImage(color_view, model.intrinsics, model.width, model.height);
  const std::uint64_t noise_seed = scene_.seed + scene_.noise_seed;
  for (std::size_t n = 0; n < frames_.size(); ++n) {
    if (closing_)
      return;
    frames_[n].depth = camera_.capture(view_.scene, view_.T_scene_camera, noise_seed + n).depth;
    frames_[n].registered_depth = registeredDepth(frames_[n].depth, model);
  }
  ready_ = true;
}

}  // namespace grasp_affordances
