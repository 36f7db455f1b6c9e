#include "simulation/sensor.h"

#include "simulation/counter_random.h"
#include "simulation/ray_caster.h"

#include <cmath>
#include <limits>
#include <optional>

namespace grasp_affordances
{

Frame Xtion::capture(const Scene& scene, const Eigen::Isometry3d& T_scene_camera, std::uint64_t seed) const
{
  const PinholeIntrinsics& camera = model_.intrinsics;
  Frame frame;
  frame.cloud.reset(model_.width, model_.height);
  frame.cloud.intrinsics = camera;
  frame.labels.assign(frame.cloud.size(), 0);

  const RayCaster caster(scene, T_scene_camera);
  std::size_t pixel = 0;
  for (std::uint32_t row = 0; row < model_.height; ++row) {
    for (std::uint32_t column = 0; column < model_.width; ++column, ++pixel) {
      const Eigen::Vector3d direction((column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0);
      const std::optional<Hit> hit = caster.cast(direction);
      if (!hit || hit->part->surface == Surface::absorbing)
        continue;
      const double depth = reportedDepth(hit->t, CounterRandom(seed, RandomStream::disparity, pixel).normal());
      if (std::isnan(depth))
        continue;
      const Eigen::Vector3f point = (depth * direction).cast<float>();
      frame.cloud.set(pixel, point.x(), point.y(), point.z());
      frame.labels[pixel] = hit->part->label;
    }
  }
  return frame;
}

double Xtion::reportedDepth(double depth, double noise) const
{
  if (!model_.exact) {
    const double focal_baseline = model_.intrinsics.fx * model_.baseline;
    const double disparity = focal_baseline / depth + model_.disparity_noise * noise;
    depth = focal_baseline / (std::round(disparity / model_.disparity_step) * model_.disparity_step);
    depth = std::round(depth / model_.depth_step) * model_.depth_step;
  }
  const bool in_range = depth >= model_.min_depth && depth <= model_.max_depth;
  return in_range ? depth : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace grasp_affordances
