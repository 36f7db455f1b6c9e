#include "simulation/sensor.h"

#include "simulation/disparity_image.h"
#include "simulation/driver_filters.h"
#include "simulation/infrared_return.h"
#include "simulation/measured_image.h"
#include "simulation/mixed_pixels.h"
#include "simulation/parallel_rows.h"
#include "simulation/projector_shadow.h"
#include "simulation/registration.h"
#include "simulation/sensor_noise.h"
#include "simulation/visible_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr float kMetresPerUnit = 0.001F;  ///< unit of a depth image
constexpr double kDeepest = 65.0;         ///< m; the limit of 16 bits is 65.5
constexpr int kLargestJitter = 2;         ///< px; the header states this limit
constexpr double kEdgeBaseline = 0.075;   ///< m, of the disparities in which a time-of-flight camera's edges are found

template <typename Task>
void forEachPixel(const SensorModel& model, Task&& task)
{
  const auto width = static_cast<int>(model.width);
  forEachRow(static_cast<int>(model.height), [&](int row) {
    for (int column = 0; column < width; ++column)
      task(Pixel{column, row}, static_cast<std::size_t>(row) * width + column);
  });
}

/// The surfaces that the sensor matches. Of a transparent surface: in some patches the surface itself, in others
/// nothing, mostly what is behind it.
SurfaceImage throughGlass(VisibleSurfaces visible, const SensorModel& model, std::uint64_t seed)
{
  constexpr double patch_size = 12.0;    // px
  constexpr double reflects = 1.5;       // above this value: 7 % of the patches
  constexpr double loses_light = -0.84;  // below this value: 20 % of the patches
  const PatchNoise patches(seed, RandomStream::transparency, patch_size);

  SurfaceImage& matched = visible.opaque;
  forEachPixel(model, [&](Pixel p, std::size_t i) {
    if (!(visible.transparent.depth[i] < matched.depth[i]))
      return;
    const double patch = model.exact ? reflects : patches(p.column, p.row);
    if (patch >= reflects) {
      matched.depth[i] = visible.transparent.depth[i];
      matched.part[i] = visible.transparent.part[i];
    } else if (patch < loses_light) {
      matched.depth[i] = std::numeric_limits<float>::infinity();
      matched.part[i] = -1;
    }
  });
  return std::move(visible.opaque);
}

/// Depth edges as the matching window displaces them.
class EdgeNoise
{
public:
  EdgeNoise(const SensorModel& model, std::uint64_t seed)
      : jitter_(model.edge_jitter),
        lost_above_(exceededBy(model.edge_loss)),
        along_row_(seed, RandomStream::edge_column, kPatch),
        along_column_(seed, RandomStream::edge_row, kPatch),
        loss_(seed, RandomStream::edge_loss, kPatch)
  {
  }

  /// The pixel whose surface is measured in a given pixel. It is another pixel only near a depth edge.
  Pixel source(const DisparityImage& disparity, Pixel p) const
  {
    if (!disparity.edgeWithin(kLargestJitter, p))
      return p;
    const auto jittered = [&](int coordinate, const PatchNoise& noise, int size) {
      const auto shift = static_cast<int>(std::round(jitter_ * noise(p.column, p.row)));
      return std::clamp(coordinate + std::clamp(shift, -kLargestJitter, kLargestJitter), 0, size - 1);
    };
    const Pixel there{jittered(p.column, along_row_, disparity.width()),
                      jittered(p.row, along_column_, disparity.height())};
    return disparity.parted(p, there) ? there : p;
  }

  bool loses(const DisparityImage& disparity, Pixel p) const
  {
    return disparity.edgeWithin(1, p) && loss_(p.column, p.row) > lost_above_;
  }

private:
  static constexpr double kPatch = 3.0;  // px

  double jitter_, lost_above_;
  PatchNoise along_row_, along_column_, loss_;
};

/// The depth that is reported for a true depth, before it is rounded to millimetres.
double measuredDepth(const SensorModel& model, double depth, double noise)
{
  if (model.principle == SensorPrinciple::time_of_flight) {
    const double deviation = model.axial_constant + depth * (model.axial_linear + depth * model.axial_quadratic);
    return depth + deviation * noise;
  }
  const double focal_baseline = model.intrinsics.fx * model.projector_x;
  const double disparity = focal_baseline / depth + model.disparity_noise * noise;
  return focal_baseline / (std::round(disparity / model.disparity_step) * model.disparity_step);
}

/// The reported depth in millimetres for a true depth; 0 if out of range.
std::uint16_t reportedDepth(const SensorModel& model, double depth, double noise)
{
  const double reported = measuredDepth(model, depth, noise);
  const bool in_range = reported >= model.min_depth && reported <= model.max_depth;
  return in_range ? static_cast<std::uint16_t>(std::round(reported / kMetresPerUnit)) : 0;
}

/// Where the projector's light, or the second camera's view, does not get.
std::vector<std::uint8_t> shadowedPixels(const SensorModel& model, const DisparityImage& disparity,
                                         const DisparityImage& occluders)
{
  std::vector<std::uint8_t> shadowed(std::size_t{model.width} * model.height, 0);
  if (model.projector_x > 0.0) {
    forEachRow(disparity.height(), [&](int row) {
      findProjectorShadow(disparity.row(row), occluders.row(row), disparity.width(),
                          &shadowed[disparity.index({0, row})]);
    });
  }
  return shadowed;
}

/// Computes the points as depth_image_proc does from the depth images of a real sensor.
void setPoint(Cloud& cloud, std::size_t i, Pixel p, std::uint16_t depth)
{
  const PinholeIntrinsics& camera = *cloud.intrinsics;
  const float x_per_unit = kMetresPerUnit / static_cast<float>(camera.fx);
  const float y_per_unit = kMetresPerUnit / static_cast<float>(camera.fy);
  cloud.set(i, (static_cast<float>(p.column) - static_cast<float>(camera.cx)) * depth * x_per_unit,
            (static_cast<float>(p.row) - static_cast<float>(camera.cy)) * depth * y_per_unit, depth * kMetresPerUnit);
}

void setImage(MeasuredImage image, Frame& frame)
{
  frame.depth = std::move(image.depth);
  frame.parts = std::move(image.parts);
  frame.surface_depth = std::move(image.surface_depth);
}

Frame exactFrame(const SensorModel& model, const Scene& scene, const SurfaceImage& surfaces,
                 const DisparityImage& disparity)
{
  Frame frame;
  frame.cloud.reset(model.width, model.height);
  frame.cloud.intrinsics = model.intrinsics;
  MeasuredImage image(model.width, model.height);
  forEachPixel(model, [&](Pixel p, std::size_t i) {
    const float depth = surfaces.depth[i];
    if (!(depth >= model.min_depth && depth <= model.max_depth) ||
        scene.parts()[surfaces.part[i]].surface == Surface::absorbing)
      return;
    const Eigen::Vector3f point = (static_cast<double>(depth) * disparity.ray(p)).cast<float>();
    frame.cloud.set(i, point.x(), point.y(), point.z());
    image.depth[i] = static_cast<std::uint16_t>(std::round(depth / kMetresPerUnit));
    image.parts[i] = surfaces.part[i];
    image.surface_depth[i] = depth;
  });
  setImage(std::move(image), frame);
  return frame;
}

/// What the depth camera measures, before its driver filters and registers it.
MeasuredImage measure(const SensorModel& model, const Scene& scene, const SurfaceImage& surfaces,
                      const DisparityImage& disparity, const DisparityImage& occluders, std::uint64_t seed)
{
  const std::vector<std::uint8_t> shadowed = shadowedPixels(model, disparity, occluders);
  const std::vector<float> noise =
      windowedNoise(seed, RandomStream::disparity, model.width, model.height, model.window_width, model.window_height);
  const EdgeNoise edges(model, seed);
  const InfraredReturn light(model, seed);
  MeasuredImage image(model.width, model.height);
  forEachPixel(model, [&](Pixel p, std::size_t i) {
    if (edges.loses(disparity, p))
      return;
    const Pixel source = edges.source(disparity, p);
    const std::size_t k = disparity.index(source);
    if (surfaces.part[k] < 0 || shadowed[k] != 0)
      return;
    const double depth = surfaces.depth[k];
    if (!light.suffices(scene.parts()[surfaces.part[k]].surface, depth * disparity.ray(source),
                        disparity.normal(source), source.column, source.row))
      return;
    const std::uint16_t reported = reportedDepth(model, depth, noise[i]);
    if (reported == 0)
      return;
    image.depth[i] = reported;
    image.parts[i] = surfaces.part[k];
    image.surface_depth[i] = surfaces.depth[k];
  });
  return image;
}

Frame frameOf(const SensorModel& model, MeasuredImage image)
{
  Frame frame;
  frame.cloud.reset(model.width, model.height);
  frame.cloud.intrinsics = model.intrinsics;
  forEachPixel(model, [&](Pixel p, std::size_t i) {
    if (image.depth[i] != 0)
      setPoint(frame.cloud, i, p, image.depth[i]);
  });
  setImage(std::move(image), frame);
  return frame;
}

}  // namespace

DepthCamera::DepthCamera(const SensorModel& model) : model_(model)
{
  if (model.width < 1 || model.height < 1 || model.window_width < 1 || model.window_height < 1)
    throw std::invalid_argument("the sensor's picture and matching window need at least one pixel");
  if (!(model.disparity_step > 0.0))
    throw std::invalid_argument("the sensor's disparity step must be positive");
  if (!(0.0 < model.min_depth && model.min_depth < model.max_depth && model.max_depth <= kDeepest))
    throw std::invalid_argument("the sensor's range must be within 0 and 65 m");
}

Frame DepthCamera::capture(const Scene& scene, const Eigen::Isometry3d& T_scene_camera, std::uint64_t seed) const
{
  // True depths come in the image that is delivered.
  const SensorModel own = model_.exact ? model_ : model_.unregistered();
  Eigen::Isometry3d T_scene_own = T_scene_camera;
  if (model_.registered() && !model_.exact)
    T_scene_own.translate(Eigen::Vector3d(model_.depth_camera.x, 0.0, 0.0));

  const auto width = static_cast<int>(own.width);
  const auto height = static_cast<int>(own.height);
  const double baseline = own.projector_x > 0.0 ? own.projector_x : kEdgeBaseline;
  VisibleSurfaces visible = findVisibleSurfaces(scene, T_scene_own, own.intrinsics, own.width, own.height);
  const DisparityImage occluders(visible.opaque.depth, width, height, own.intrinsics, baseline);
  const SurfaceImage surfaces = throughGlass(std::move(visible), own, seed);
  const DisparityImage disparity(surfaces.depth, width, height, own.intrinsics, baseline);
  if (model_.exact)
    return exactFrame(own, scene, surfaces, disparity);

  MeasuredImage image = measure(own, scene, surfaces, disparity, occluders, seed);
  MixedPixels{own.edge_ramp, own.flying_share}.apply(disparity, seed, image);
  fillHoles(own.fill_width, image);
  smoothDepth(own.smoothing_radius, own.smoothing_step / kMetresPerUnit, image);
  return frameOf(model_, model_.registered() ? registered(image, model_) : std::move(image));
}

}  // namespace grasp_affordances
