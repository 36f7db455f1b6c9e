#pragma once

#include "core/hand_poses/hand_pose_search.h"
#include "core/parallel/thread_team.h"
#include "core/views/prepared_views.h"
#include "simulation/placement.h"
#include "simulation/sensor.h"
#include "support/points.h"
#include "support/same_bits.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace grasp_affordances::test
{

using Pose = Eigen::Isometry3d;
using Vector = Eigen::Vector3d;

inline SensorModel exactSensor()
{
  SensorModel model;
  model.exact = true;
  return model;
}

inline Cloud capture(const Scene& scene, const Pose& T_scene_camera = Pose::Identity())
{
  return DepthCamera(exactSensor()).capture(scene, T_scene_camera, 1).cloud;
}

/// A straight handle with its middle at a point.
inline GraspHandle handleAt(const Vector& centroid, const Vector& axis, const Vector& normal, double inner_radius,
                            double length)
{
  GraspHandle handle;
  handle.centroid = centroid;
  handle.axis = axis.normalized();
  handle.normal = (normal - normal.dot(handle.axis) * handle.axis).normalized();
  handle.radius = handle.inner_radius = inner_radius;
  handle.length = length;
  handle.polyline = {centroid - length / 2 * handle.axis, centroid + length / 2 * handle.axis};
  return handle;
}

/// Clouds of one moment, prepared once for many searches.
class Moment
{
public:
  Moment(const std::vector<PosedCloud>& clouds, const Config& config)
  {
    ThreadTeam team(1);
    views_.update(clouds, config, Pose::Identity(), team);
  }

  std::vector<GraspPose> search(const Config& config, GraspHandle handle,
                                const Pose& T_approach_common = Pose::Identity())
  {
    search_.search(views_, config, T_approach_common, handle);
    return handle.hand_poses;
  }

private:
  PreparedViews views_;
  HandPoseSearch search_;
};

inline std::vector<GraspPose> search(const std::vector<PosedCloud>& clouds, const Config& config,
                                     const GraspHandle& handle)
{
  return Moment(clouds, config).search(config, handle);
}

inline std::vector<GraspPose> search(const Cloud& cloud, const Config& config, const GraspHandle& handle,
                                     const Pose& T_approach_common = Pose::Identity())
{
  return Moment({{&cloud, Pose::Identity()}}, config).search(config, handle, T_approach_common);
}

inline Vector approach(const GraspPose& hand)
{
  return hand.pose.linear().col(0);
}

/// The pose among some whose approach is a direction (within 1e-6), at a point.
inline std::optional<GraspPose> findApproach(const std::vector<GraspPose>& hands, const Vector& direction,
                                             const Vector& at)
{
  for (const GraspPose& hand : hands) {
    if ((approach(hand) - direction.normalized()).norm() < 1e-6 && (hand.pose.translation() - at).norm() < 1e-9) {
      return hand;
    }
  }
  return std::nullopt;
}

inline bool sameBytes(const std::vector<GraspPose>& a, const std::vector<GraspPose>& b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const GraspPose& x, const GraspPose& y) {
           return x.pose.matrix() == y.pose.matrix() && x.width == y.width && x.score == y.score &&
                  sameBits(x.observed_free, y.observed_free);
         });
}

/// A hand that comes from a direction on a handle's ring, by angle from the normal.
inline Pose handFrom(const GraspHandle& handle, double angle)
{
  const Vector radial = std::cos(angle) * handle.normal + std::sin(angle) * handle.axis.cross(handle.normal);
  Pose T_common_hand;
  T_common_hand.linear() << -radial, handle.axis.cross(-radial), handle.axis;
  T_common_hand.translation() = handle.centroid;
  return T_common_hand;
}

/// A bar along x, 0.8 m in front of the camera, whose frame is the scene's; and a wall so far behind it.
inline Scene barInFrontOfWall(double distance, double radius = 0.01)
{
  Scene scene;
  scene.beginObject("bar");
  scene.add(Cylinder{radius, 0.3}, halfway(Vector(-0.15, 0.0, 0.8), Vector(0.15, 0.0, 0.8)));
  scene.beginObject("wall");
  scene.add(Box{{4.0, 4.0, 0.1}}, at(0.0, 0.0, 0.8 + distance + 0.05));
  return scene;
}

inline GraspHandle barHandle()
{
  return handleAt(Vector(0.0, 0.0, 0.8), Vector::UnitX(), -Vector::UnitZ(), 0.012, 0.05);
}

/// Seen from above at a slant. Scene frame: z up from the table's top.
struct TableTop
{
  TableTop()
  {
    scene.beginObject("table");
    scene.add(Box{{1.6, 1.2, 0.03}}, at(0.0, 0.25, -0.015));
    T_scene_camera = lookAt(Vector(0.0, -0.5, 0.6), Vector(0.0, 0.0, 0.1));
  }

  /// A handle given in the scene, in the camera's frame.
  GraspHandle inCamera(GraspHandle handle) const { return transformed(std::move(handle), T_scene_camera.inverse()); }

  bool anyFrom(const std::vector<GraspPose>& hands, const Vector& approach_scene, double max_angle) const
  {
    return std::any_of(hands.begin(), hands.end(), [&](const GraspPose& hand) {
      return (T_scene_camera.linear() * approach(hand)).dot(approach_scene) > std::cos(max_angle);
    });
  }

  Scene scene;
  Pose T_scene_camera;
};

}  // namespace grasp_affordances::test
