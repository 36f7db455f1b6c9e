#include "evaluation/labelled_cloud.h"

#include "simulation/camera_orbit.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <exception>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr std::uint64_t kNoiseOfNextView = 1000000;  // is that of a seed so much larger

void transform(const Eigen::Isometry3d& T, Affordance& affordance)
{
  for (Eigen::Vector3d& point : affordance.axis) {
    point = T * point;
  }
  if (affordance.ball_center) {
    *affordance.ball_center = T * *affordance.ball_center;
  }
}

/// Which object of the scene each point is on.
void nameObjects(const Scene& scene, const std::vector<std::int32_t>& parts, LabelledCloud& labelled)
{
  labelled.object_names = scene.objects();
  labelled.object_names.emplace_back();
  labelled.objects.clear();
  for (const std::int32_t part : parts) {
    const std::size_t object = part < 0 ? scene.objects().size() : scene.parts()[static_cast<std::size_t>(part)].object;
    labelled.objects.push_back(static_cast<std::uint32_t>(object));
  }
}

LabelledCloud render(const View& view, std::uint64_t seed, const GraspDefinition& definition,
                     const std::vector<double>& turns, const DepthCamera& camera)
{
  std::vector<View> views;
  std::vector<Eigen::Isometry3d> cameras;
  for (const double turn : turns) {
    views.push_back(viewFromAside(view, turn));
    cameras.push_back(views.back().T_scene_camera);
  }
  LabelledCloud labelled;
  labelled.capture_radius = definition.capture_radius;
  for (std::size_t i = 0; i < views.size(); ++i) {
    Frame frame = camera.capture(views[i].scene, cameras[i], seed + i * kNoiseOfNextView);
    GroundTruth truth = groundTruth(views[i], frame, camera.model(), definition, cameras);
    if (i == 0) {
      nameObjects(views[i].scene, frame.parts, labelled);
      labelled.cloud = std::move(frame.cloud);
      labelled.labels = std::move(truth.labels);
      labelled.affordances = std::move(truth.affordances);
      for (Affordance& affordance : labelled.affordances) {
        transform(cameras.front().inverse(), affordance);
      }
    } else {
      labelled.further_views.push_back(
          {std::move(frame.cloud), cameras.front().inverse() * cameras[i], std::move(truth.labels)});
    }
  }
  return labelled;
}

}  // namespace

LabelledCloud united(const LabelledCloud& labelled, std::size_t views)
{
  LabelledCloud result;
  result.affordances = labelled.affordances;
  result.capture_radius = labelled.capture_radius;
  std::vector<Eigen::Vector3f> points;
  const auto append = [&](const Cloud& cloud, const Eigen::Isometry3d& T_first_this,
                          const std::vector<std::uint32_t>& labels) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.measured(i)) {
        points.emplace_back((T_first_this * cloud.point(i).cast<double>()).cast<float>());
        result.labels.push_back(labels[i]);
      }
    }
  };
  append(labelled.cloud, Eigen::Isometry3d::Identity(), labelled.labels);
  for (std::size_t i = 0; i + 1 < views; ++i) {
    const FurtherView& view = labelled.further_views[i];
    append(view.cloud, view.T_first_this, view.labels);
  }
  result.cloud.sensor_origin = Eigen::Vector3f::Zero();  // of the first view
  result.cloud.reset(static_cast<std::uint32_t>(points.size()), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.cloud.set(i, points[i].x(), points[i].y(), points[i].z());
  }
  return result;
}

EvaluationFrame renderedFrame(const std::string& group, const std::string& scene, std::uint64_t seed,
                              const GraspDefinition& definition, const std::vector<double>& turns,
                              const SensorModel& sensor, Background background)
{
  const auto load = [scene, seed, definition, turns, sensor, background] {
    try {
      return render(makeScene(scene, seed, background), seed, definition, turns, DepthCamera(sensor));
    } catch (const std::exception& error) {
      throw std::runtime_error(scene + ", seed " + std::to_string(seed) + ": " + error.what());
    }
  };
  return {group, scene, seed, load};
}

}  // namespace grasp_affordances
