#include "simulation/arrangement.h"

#include "simulation/sensor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

namespace grasp_affordances
{
namespace
{

constexpr double kDepthInside = 0.0015;  ///< m
constexpr double kSpacing = 0.015;       ///< m
constexpr int kTries = 600;
constexpr double kWidening = 0.02;   ///< relative increase of the spread with every try
constexpr double kInPicture = 0.95;  ///< share of an object's points that must be in the picture

void appendPointsInside(const Part& part, std::vector<Eigen::Vector3d>& points)
{
  if (std::holds_alternative<HalfSpace>(part.shape))
    return;
  const Eigen::AlignedBox3d bounds = boundingBox(part.shape);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
    const auto rays = [&](int side) {
      return std::max(3, static_cast<int>(std::ceil(bounds.sizes()[side] / kSpacing)));
    };
    for (int i = 0; i < rays(u); ++i) {
      for (int j = 0; j < rays(v); ++j) {
        Ray ray{bounds.min() - 0.01 * direction, direction};
        ray.origin[u] += (i + 0.5) / rays(u) * bounds.sizes()[u];
        ray.origin[v] += (j + 0.5) / rays(v) * bounds.sizes()[v];
        double sign = 1.0;
        for (double t = intersect(part.shape, ray); t < kNoIntersection; t = intersect(part.shape, ray), sign = -sign) {
          const Eigen::Vector3d point = ray.origin + (t + sign * kDepthInside) * direction;
          if (contains(part.shape, point))
            points.push_back(part.T_scene_shape * point);
          ray.origin += (t + 1e-6) * direction;
        }
      }
    }
  }
}

bool anyContained(const Scene& scene, std::size_t object, const std::vector<Eigen::Vector3d>& points)
{
  for (const Part& part : scene.parts()) {
    if (part.object != object)
      continue;
    const Eigen::Isometry3d T_shape_scene = part.T_scene_shape.inverse();
    if (std::any_of(points.begin(), points.end(),
                    [&](const Eigen::Vector3d& point) { return contains(part.shape, T_shape_scene * point); }))
      return true;
  }
  return false;
}

View emptyStage(const Stage& stage, CounterRandom& random)
{
  View view;
  if (stage.support == Stage::Support::table) {
    const double yaw = kDegree * random.uniform(-10.0, 10.0);
    view.scene.beginObject("table", Role::support);
    view.scene.add(Box{{stage.table_size.x(), stage.table_size.y(), 0.03}},
                   upright(0.0, 0.04, yaw) * at(0.0, 0.0, -0.015));
    view.scene.beginObject("floor", Role::floor);
    view.scene.add(HalfSpace{}, at(0.0, 0.0, -0.72));
  } else {
    view.scene.beginObject("floor", Role::support);
    view.scene.add(HalfSpace{}, Eigen::Isometry3d::Identity());
  }
  if (stage.wall > 0.0) {
    view.scene.beginObject("wall", Role::wall);
    view.scene.add(HalfSpace{}, at(0.0, stage.wall, 0.0) * turned(0.5 * kPi, Eigen::Vector3d::UnitX()));
  }

  const double elevation = kDegree * random.uniform(stage.min_elevation, stage.max_elevation);
  const double azimuth = kDegree * random.uniform(-10.0, 10.0);
  const double distance = random.uniform(stage.min_distance, stage.max_distance);
  const Eigen::Vector3d towards_camera(std::cos(elevation) * std::sin(azimuth),
                                       -std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
  const Eigen::Vector3d middle(0.0, 0.0, stage.middle_height);
  view.T_scene_camera = lookAt(middle + distance * towards_camera, middle);
  return view;
}

}  // namespace

std::vector<Eigen::Vector3d> pointsInside(const Scene& scene, std::size_t object)
{
  std::vector<Eigen::Vector3d> points;
  for (const Part& part : scene.parts()) {
    if (part.object == object)
      appendPointsInside(part, points);
  }
  return points;
}

void append(const Scene& from, const Eigen::Isometry3d& T_to_from, Scene& to)
{
  const std::size_t first_part = to.parts().size();
  std::size_t next_object = 0;
  for (const Part& part : from.parts()) {
    for (; next_object <= part.object; ++next_object)
      to.beginObject(from.objects()[next_object], from.roles()[next_object]);
    to.add(part.shape, T_to_from * part.T_scene_shape, part.surface);
  }
  for (std::vector<std::size_t> chain : from.chains()) {
    for (std::size_t& part : chain)
      part += first_part;
    to.join(chain);
  }
}

Arrangement::Arrangement(const Stage& stage, CounterRandom& random)
    : stage_(stage),
      view_(emptyStage(stage, random)),
      stage_objects_(view_.scene.objects().size()),
      random_(random),
      mirrored_(random.coin())
{
}

Arrangement::Body::Body(const Scene& scene) : alone(scene)
{
  for (std::size_t object = 0; object < scene.objects().size(); ++object) {
    const std::vector<Eigen::Vector3d> inside = pointsInside(scene, object);
    points.insert(points.end(), inside.begin(), inside.end());
  }
}

Arrangement::Body::Body(const Body& body, const Eigen::Isometry3d& T)
{
  append(body.alone, T, alone);
  for (const Eigen::Vector3d& point : body.points) {
    points.push_back(T * point);
    bounds.extend(points.back());
  }
}

Eigen::Isometry3d Arrangement::draw(const Spot& spot, double widening)
{
  const Eigen::Vector2d spread = widening * spot.spread;
  const double x = spot.middle.x() + random_.uniform(-spread.x(), spread.x());
  const double y = spot.middle.y() + random_.uniform(-spread.y(), spread.y());
  const double yaw = kDegree * (spot.yaw + random_.uniform(-spot.turn, spot.turn));
  return at(0.0, 0.0, spot.height) * (mirrored_ ? upright(-x, y, kPi - yaw) : upright(x, y, yaw));
}

Eigen::Isometry3d Arrangement::place(const Scene& object, const Spot& spot)
{
  const Body body(object);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const Eigen::Isometry3d pose = draw(spot, 1.0 + kWidening * attempt);
    if (put(body, pose))
      return pose;
  }
  throw std::runtime_error("no room for object '" + object.objects().front() + "'");
}

bool Arrangement::tryToPlace(const Scene& object, const Spot& spot, int tries)
{
  const Body body(object);
  for (int attempt = 0; attempt < tries; ++attempt) {
    if (put(body, draw(spot, 1.0)))
      return true;
  }
  return false;
}

bool Arrangement::put(const Body& body, const Eigen::Isometry3d& T_scene_body)
{
  const Body placed(body, T_scene_body);
  if (!inRange(placed) || !inPicture(placed) || intoStage(placed) ||
      std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& other) { return !apart(placed, other); }))
    return false;
  append(body.alone, T_scene_body, view_.scene);
  bodies_.push_back(placed);
  return true;
}

bool Arrangement::inRange(const Body& body) const
{
  const double distance = (body.bounds.center() - view_.T_scene_camera.translation()).norm();
  return distance > stage_.nearest_object && distance < stage_.farthest_object;
}

bool Arrangement::inPicture(const Body& body) const
{
  const SensorModel model;
  const Eigen::Isometry3d T_camera_scene = view_.T_scene_camera.inverse();
  const auto inside = std::count_if(body.points.begin(), body.points.end(), [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = T_camera_scene * point;
    const double column = model.intrinsics.fx * p.x() / p.z() + model.intrinsics.cx;
    const double row = model.intrinsics.fy * p.y() / p.z() + model.intrinsics.cy;
    return p.z() > model.min_depth && column > 0.0 && column < model.width && row > 0.0 && row < model.height;
  });
  return static_cast<double>(inside) >= kInPicture * static_cast<double>(body.points.size());
}

bool Arrangement::intoStage(const Body& body) const
{
  for (std::size_t object = 0; object < stage_objects_; ++object) {
    if (anyContained(view_.scene, object, body.points))
      return true;
  }
  return false;
}

bool Arrangement::apart(const Body& a, const Body& b) const
{
  // The bounds are those of points inside the material, kDepthInside below the surfaces.
  if (a.bounds.exteriorDistance(b.bounds) > gap_ + 2.0 * kDepthInside)
    return true;
  for (const Eigen::Vector3d& p : a.points) {
    if (b.bounds.squaredExteriorDistance(p) > gap_ * gap_)
      continue;
    for (const Eigen::Vector3d& q : b.points) {
      if ((p - q).squaredNorm() < gap_ * gap_)
        return false;
    }
  }
  const auto goesInto = [](const Body& from, const Body& into) {
    for (std::size_t object = 0; object < into.alone.objects().size(); ++object) {
      if (anyContained(into.alone, object, from.points))
        return true;
    }
    return false;
  };
  return !goesInto(a, b) && !goesInto(b, a);
}

}  // namespace grasp_affordances
