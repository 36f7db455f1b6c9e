#include "simulation/ground_truth.h"

#include "simulation/grip_labels.h"
#include "simulation/ray_caster.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace grasp_affordances
{
namespace
{

constexpr double kLeastMargin = 0.001;         ///< m
constexpr double kRaysPerAffordance = 2000.0;  ///< approximate largest number of rays for an occluded share

/// Direction of the ray through a place in the image. Its z is 1, so that the ray's parameter is the depth.
Eigen::Vector3d directionThrough(const PinholeIntrinsics& camera, double column, double row)
{
  return {(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0};
}

std::vector<std::uint32_t> labelsOfPixels(const View& view, const Frame& frame, const SensorModel& model,
                                          const GripLabels& labels)
{
  std::vector<Eigen::Isometry3d> T_shape_camera;
  for (const Part& part : view.scene.parts())
    T_shape_camera.push_back(part.T_scene_shape.inverse() * view.T_scene_camera);

  std::vector<std::uint32_t> result(frame.parts.size(), kNotGraspable);
  for (std::size_t pixel = 0; pixel < result.size(); ++pixel) {
    if (frame.parts[pixel] < 0)
      continue;
    const auto part = static_cast<std::size_t>(frame.parts[pixel]);
    if (!labels.any(part))
      continue;
    const std::size_t u = pixel % model.width, v = pixel / model.width;
    const Eigen::Vector3d direction =
        directionThrough(model.intrinsics, static_cast<double>(u), static_cast<double>(v));
    result[pixel] = labels.label(part, T_shape_camera[part] * (frame.surface_depth[pixel] * direction));
  }
  return result;
}

/// The pixels to which spheres along a grip's axis can project.
Eigen::AlignedBox2d imageOf(const Grip& grip, const Eigen::Isometry3d& T_camera_scene, const SensorModel& model)
{
  const PinholeIntrinsics& camera = model.intrinsics;
  const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(), Eigen::Vector2d(model.width - 1, model.height - 1));
  const double radius = grip.radius + 0.005;  // the points on the axis are 4 mm apart
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& on_axis : grip.axis) {
    const Eigen::Vector3d centre = T_camera_scene * on_axis;
    if (centre.z() <= 2.0 * radius)
      return image;
    for (const double x : {centre.x() - radius, centre.x() + radius}) {
      for (const double y : {centre.y() - radius, centre.y() + radius}) {
        for (const double z : {centre.z() - radius, centre.z() + radius})
          box.extend(Eigen::Vector2d(camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy));
      }
    }
  }
  return box.intersection(image);
}

/// Where a ray of the camera first meets a grip, if there were nothing else, not even the rest of the grip's parts.
double firstHit(const View& view, const GripLabels& labels, const Grip& grip, const Eigen::Vector3d& direction)
{
  constexpr double kPastSurface = 1e-9;
  double first = kNoIntersection;
  for (const std::size_t part : grip.parts) {
    const Part& solid = view.scene.parts()[part];
    const Eigen::Isometry3d T_shape_camera = solid.T_scene_shape.inverse() * view.T_scene_camera;
    Ray ray{T_shape_camera.translation(), T_shape_camera.linear() * direction};
    for (double t = 0.0; t < first;) {
      const double step = intersect(solid.shape, ray);
      t += step;
      if (!(t < first))
        break;
      const Eigen::Vector3d point = ray.origin + step * ray.direction;
      if (labels.label(part, point) == grip.label)
        first = t;
      t += kPastSurface;
      ray.origin = point + kPastSurface * ray.direction;
    }
  }
  return first;
}

double occludedShare(const View& view, const RayCaster& everything, const GripLabels& labels, const Grip& grip,
                     const SensorModel& model)
{
  const Eigen::AlignedBox2d box = imageOf(grip, view.T_scene_camera.inverse(), model);
  if (box.isEmpty())
    return 0.0;
  const double step = std::max(1.0, std::ceil(std::sqrt(box.volume() / kRaysPerAffordance)));
  std::size_t filled = 0, occluded = 0;
  for (double row = std::ceil(box.min().y()); row <= box.max().y(); row += step) {
    for (double column = std::ceil(box.min().x()); column <= box.max().x(); column += step) {
      const Eigen::Vector3d direction = directionThrough(model.intrinsics, column, row);
      const double own = firstHit(view, labels, grip, direction);
      if (own == kNoIntersection)
        continue;
      ++filled;
      const std::optional<Hit> first = everything.cast(direction);
      if (first && first->t < own - 1e-6)
        ++occluded;
    }
  }
  return filled == 0 ? 0.0 : static_cast<double>(occluded) / static_cast<double>(filled);
}

}  // namespace

GroundTruth groundTruth(const View& view, const Frame& frame, const SensorModel& model,
                        const GraspDefinition& definition, const std::vector<Eigen::Isometry3d>& other_cameras)
{
  const Eigen::Isometry3d T_camera_scene = view.T_scene_camera.inverse();
  std::vector<Eigen::Vector3d> cameras = {view.T_scene_camera.translation()};
  for (const Eigen::Isometry3d& T_scene_other : other_cameras)
    cameras.emplace_back(T_scene_other.translation());
  const auto margin_at = [&](const Eigen::Vector3d& point_scene) {
    double margin = std::max(kLeastMargin, model.depthQuantum((T_camera_scene * point_scene).z()));
    for (const Eigen::Isometry3d& T_scene_other : other_cameras)
      margin = std::max(margin, model.depthQuantum((T_scene_other.inverse() * point_scene).z()));
    return margin;
  };
  const GripLabels labels(view.scene, definition, margin_at, cameras);

  GroundTruth truth;
  truth.labels = labelsOfPixels(view, frame, model, labels);
  const RayCaster everything(view.scene, view.T_scene_camera);
  for (const Grip& grip : labels.grips()) {
    Affordance affordance;
    affordance.label = grip.label;
    affordance.object = view.scene.objects()[view.scene.parts()[grip.parts.front()].object];
    affordance.radius = grip.radius;
    affordance.length = grip.length;
    affordance.axis = grip.axis;
    affordance.radii = grip.radii;
    affordance.ball_center = grip.ball_center;
    const Eigen::Vector3d middle = 0.5 * (grip.axis[(grip.axis.size() - 1) / 2] + grip.axis[grip.axis.size() / 2]);
    affordance.distance = (T_camera_scene * middle).norm();
    affordance.visible_points =
        static_cast<std::size_t>(std::count(truth.labels.begin(), truth.labels.end(), grip.label));
    affordance.occluded_share = occludedShare(view, everything, labels, grip, model);
    truth.affordances.push_back(std::move(affordance));
  }
  return truth;
}

}  // namespace grasp_affordances
