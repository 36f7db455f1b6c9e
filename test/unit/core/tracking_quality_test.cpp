// Handles before a moving camera: whether they keep their ids, and how still they stand. See docs/tracking.md.

#include "evaluation/parallel.h"
#include "grasp_affordances/handle_tracker.h"
#include "grasp_affordances/localizer.h"
#include "simulation/camera_orbit.h"
#include "simulation/ground_truth.h"
#include "simulation/paper_scenes.h"
#include "simulation/placement.h"
#include "simulation/sensor.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr double kPeriod = 0.1;               // s, between frames
constexpr double kAmplitude = 5.0 * kDegree;  // of the orbit, and its period, as of the simulated camera
constexpr double kOrbitPeriod = 10.0;         // s
constexpr std::size_t kVisiblePoints = 200;
constexpr double kOnAxis = 0.015;     // m, from a handle to the axis of the affordance that it is on
constexpr std::size_t kSettled = 10;  // frames, before jitter is measured
constexpr double kLeastDistance = 0.6, kMostDistance = 1.0;  // m, of affordances whose jitter is measured

/// Mean distance of points from a polyline.
double distanceFrom(const std::vector<Eigen::Vector3d>& line, const std::vector<Eigen::Vector3d>& points)
{
  double sum = 0.0;
  for (const Eigen::Vector3d& point : points) {
    double least = (line.front() - point).norm();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Eigen::Vector3d piece = line[i + 1] - line[i];
      const double t = std::clamp((point - line[i]).dot(piece) / std::max(piece.squaredNorm(), 1e-12), 0.0, 1.0);
      least = std::min(least, (line[i] + t * piece - point).norm());
    }
    sum += least;
  }
  return sum / static_cast<double>(points.size());
}

/// The affordance that a handle is on: the nearest; none where that is farther than kOnAxis.
std::uint32_t affordanceOf(const GraspHandle& handle, const std::vector<Affordance>& affordances)
{
  std::uint32_t label = 0;
  double nearest = kOnAxis;
  std::vector<Eigen::Vector3d> points = handle.polyline;
  points.push_back(handle.centroid);
  for (const Affordance& affordance : affordances) {
    const double distance = affordance.axis.empty() ? nearest : distanceFrom(affordance.axis, points);
    if (distance < nearest) {
      nearest = distance;
      label = affordance.label;
    }
  }
  return label;
}

/// A handle's poses from frame to frame.
struct Course
{
  double distance = 0.0;  // m, of its affordance
  std::vector<Eigen::Vector3d> centroids;
  std::vector<Eigen::Vector3d> axes;
};

struct Jitter
{
  double across = 0.0, along = 0.0, angle = 0.0;  // standard deviations: m, m, rad
};

Jitter jitter(const Course& course)
{
  const auto frames = static_cast<double>(course.centroids.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < course.centroids.size(); ++i) {
    scatter += course.axes[i] * course.axes[i].transpose() / frames;
    mean += course.centroids[i] / frames;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  Jitter squares;
  for (std::size_t i = 0; i < course.centroids.size(); ++i) {
    const Eigen::Vector3d offset = course.centroids[i] - mean;
    const double along = offset.dot(axis);
    squares.along += along * along / frames;
    squares.across += (offset.squaredNorm() - along * along) / 2.0 / frames;  // of each of the two directions
    const double angle = std::acos(std::min(1.0, std::abs(course.axes[i].dot(axis))));
    squares.angle += angle * angle / frames;
  }
  return {std::sqrt(std::max(squares.across, 0.0)), std::sqrt(squares.along), std::sqrt(squares.angle)};
}

struct Quality
{
  std::size_t frames = 0;       // times affordances that show enough points and had an id before
  std::size_t kept = 0;         // of those, with that id on them
  std::size_t seen = 0;         // of those, found in that very frame
  std::size_t affordances = 0;  // that show enough points in the first frame
  std::size_t reported = 0;     // of those, ever
  std::size_t handles = 0;      // on affordances, summed over the frames
  std::vector<Jitter> jitters;

  Quality& operator+=(const Quality& other)
  {
    frames += other.frames;
    kept += other.kept;
    seen += other.seen;
    affordances += other.affordances;
    reported += other.reported;
    handles += other.handles;
    jitters.insert(jitters.end(), other.jitters.begin(), other.jitters.end());
    return *this;
  }

  double keptShare() const { return static_cast<double>(kept) / static_cast<double>(std::max<std::size_t>(frames, 1)); }
  double quantile(double Jitter::*field, double share) const
  {
    std::vector<double> values;
    for (const Jitter& jitter : jitters) {
      values.push_back(jitter.*field);
    }
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
};

/// Follows the handles on the affordances of one scene.
class Observer
{
public:
  void observe(const std::vector<Affordance>& affordances, const std::vector<GraspHandle>& known, std::size_t frame)
  {
    std::map<std::uint32_t, std::vector<const GraspHandle*>> on;
    for (const GraspHandle& handle : known) {
      on[affordanceOf(handle, affordances)].push_back(&handle);
    }
    for (const Affordance& affordance : affordances) {
      if (affordance.visible_points >= kVisiblePoints) {
        observe(affordance, on[affordance.label], frame);
      }
    }
  }

  Quality quality() const
  {
    Quality result = quality_;
    result.affordances = affordances_.size();
    result.reported = ids_.size();
    for (const auto& [id, course] : courses_) {
      if (course.centroids.size() >= kSettled && course.distance > kLeastDistance && course.distance < kMostDistance) {
        result.jitters.push_back(jitter(course));
      }
    }
    return result;
  }

private:
  void observe(const Affordance& affordance, const std::vector<const GraspHandle*>& handles, std::size_t frame)
  {
    affordances_[affordance.label] = true;
    const auto id = ids_.find(affordance.label);
    const GraspHandle* chosen = nullptr;
    for (const GraspHandle* handle : handles) {
      if (id != ids_.end() && handle->id == id->second) {
        chosen = handle;
      }
    }
    if (id != ids_.end()) {
      ++quality_.frames;
      quality_.handles += handles.size();
      quality_.kept += chosen != nullptr ? 1 : 0;
      quality_.seen += chosen != nullptr && chosen->unseen_for == 0.0 ? 1 : 0;
    }
    if (chosen == nullptr) {
      for (const GraspHandle* handle : handles) {
        if (chosen == nullptr || handle->length > chosen->length) {
          chosen = handle;
        }
      }
    }
    if (chosen == nullptr) {
      return;
    }
    ids_[affordance.label] = chosen->id;
    if (frame >= kSettled) {
      Course& course = courses_[chosen->id];
      course.distance = affordance.distance;
      course.centroids.push_back(chosen->centroid);
      course.axes.push_back(chosen->axis);
    }
  }

  Quality quality_;
  std::map<std::uint32_t, bool> affordances_;
  std::map<std::uint32_t, std::uint32_t> ids_;  // by label
  std::map<std::uint32_t, Course> courses_;     // by id
};

Quality watch(const NamedScene& scene, std::uint64_t seed, std::size_t frames, const Config& config)
{
  const View view = scene.generate(seed);
  const CameraOrbit orbit(view, kAmplitude, kOrbitPeriod);
  const DepthCamera camera;
  Localizer localizer(config);
  HandleTracker tracker(config.tracking);
  Observer observer;
  Localization localization;
  for (std::size_t i = 0; i < frames; ++i) {
    const double time = kPeriod * static_cast<double>(i);
    const View moved{view.scene, orbit.pose(time)};
    const Frame frame = camera.capture(moved.scene, moved.T_scene_camera, seed + i);
    const std::vector<Affordance> affordances = groundTruth(moved, frame, camera.model()).affordances;
    localizer.localize(frame.cloud, localization);
    for (GraspHandle& handle : localization.handles) {
      handle = transformed(std::move(handle), moved.T_scene_camera);
    }
    observer.observe(affordances, tracker.update(localization.handles, time), i);
  }
  return observer.quality();
}

std::size_t numberFrom(const char* variable, std::size_t otherwise)
{
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoul(text, nullptr, 10);
}

void print(const std::string& name, const Quality& quality)
{
  std::printf("| %-10s | %zu of %zu | %6.2f | %6.2f | %5.2f | %zu | %4.1f %4.1f | %4.1f %4.1f | %4.1f %4.1f |\n",
              name.c_str(), quality.reported, quality.affordances, 100.0 * quality.keptShare(),
              100.0 * static_cast<double>(quality.seen) / static_cast<double>(std::max<std::size_t>(quality.frames, 1)),
              static_cast<double>(quality.handles) / static_cast<double>(std::max<std::size_t>(quality.frames, 1)),
              quality.jitters.size(), 1000.0 * quality.quantile(&Jitter::across, 0.5),
              1000.0 * quality.quantile(&Jitter::across, 0.95), 1000.0 * quality.quantile(&Jitter::along, 0.5),
              1000.0 * quality.quantile(&Jitter::along, 0.95), quality.quantile(&Jitter::angle, 0.5) / kDegree,
              quality.quantile(&Jitter::angle, 0.95) / kDegree);
}

/// The environment variables GRASP_AFFORDANCES_TRACKING_SEEDS (1), ..._FIRST_SEED (201) and ..._FRAMES (25) make it
/// longer: docs/tracking.md is of 3 seeds and 60 frames.
TEST(TrackingQuality, HandlesKeepTheirIdsAndStandStillBeforeAMovingCamera)
{
  const std::size_t frames = numberFrom("GRASP_AFFORDANCES_TRACKING_FRAMES", 25);
  const std::size_t seeds = numberFrom("GRASP_AFFORDANCES_TRACKING_SEEDS", 1);
  const std::size_t first_seed = numberFrom("GRASP_AFFORDANCES_TRACKING_FIRST_SEED", 201);
  const std::vector<NamedScene> scenes = paperScenes();
  Config config;
  config.threads = 1;
  std::vector<Quality> qualities(scenes.size() * seeds);
  forEachInParallel(qualities.size(), 0, [&](std::size_t i) {
    qualities[i] = watch(scenes[i / seeds], first_seed + i % seeds, frames, config);
  });

  std::puts(
      "scene | reported | id kept, % | found, % | handles per affordance | handles | jitter, median and 95 %: across, "
      "mm | along, mm | angle, degrees");
  Quality all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    Quality quality;
    for (std::size_t k = 0; k < seeds; ++k) {
      quality += qualities[i * seeds + k];
    }
    print(scenes[i].name, quality);
    all += quality;
  }
  print("all", all);
  EXPECT_GT(all.frames, 800U);
  EXPECT_GE(all.keptShare(), 0.99);
  EXPECT_GT(all.jitters.size(), 20U);
  constexpr double kMostHandles = 0.9;
  EXPECT_LT(all.quantile(&Jitter::across, kMostHandles), 0.003);
  EXPECT_LT(all.quantile(&Jitter::along, kMostHandles), 0.003);
  EXPECT_LT(all.quantile(&Jitter::angle, kMostHandles), 2.0 * kDegree);
}

}  // namespace
}  // namespace grasp_affordances::test
