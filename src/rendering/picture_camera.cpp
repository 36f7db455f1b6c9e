#include "rendering/picture_camera.h"

#include "core/cloud/usable_cloud.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kNear = 1e-3;  // m; nearer points are not projected

/// Rotation from the cloud's frame to the camera's; its rows are the camera's x, y and z axis. If the camera looks
/// along the cloud's z, the cloud's frame is taken as an optical frame, whose y points down. Otherwise its z is taken
/// as up.
Eigen::Matrix3d cameraRotation(const Eigen::Vector3d& forward)
{
  const Eigen::Vector3d down = forward.z() > 0.7 ? Eigen::Vector3d(0, 1, 0) : Eigen::Vector3d(0, 0, -1);
  Eigen::Vector3d right = down.cross(forward);
  if (right.norm() < 1e-3) {
    right = Eigen::Vector3d::UnitX();
  }
  Eigen::Matrix3d rotation;
  rotation.row(0) = right.normalized();
  rotation.row(2) = forward;
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  return rotation;
}

/// Where the camera stands: at the sensor or, where its place is not known, at the origin. From among the points it
/// would see little of them: then it stands back and looks down at a slant, with z up.
Eigen::Vector3d standpoint(const Cloud& cloud)
{
  if (cloud.sensor_origin) {
    return cloud.sensor_origin->cast<double>();
  }
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      box.extend(cloud.point(i).cast<double>());
    }
  }
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (!box.contains(origin)) {
    return origin;
  }
  constexpr double kDiagonals = 1.5;  // of the box, from its middle
  return box.center() - kDiagonals * box.diagonal().norm() * Eigen::Vector3d(1.0, 0.5, -0.7).normalized();
}

PictureCamera virtualCamera(const Cloud& cloud)
{
  PictureCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.intrinsics = {525.0, 525.0, 319.5, 239.5};
  const Eigen::Vector3d origin = standpoint(cloud);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t measured = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      sum += cloud.point(i).cast<double>() - origin;
      ++measured;
    }
  }
  const bool has_direction = measured > 0 && sum.norm() > 1e-6 * static_cast<double>(measured);
  const Eigen::Vector3d forward = has_direction ? sum.normalized() : Eigen::Vector3d::UnitZ();
  camera.camera_from_cloud.linear() = cameraRotation(forward);
  camera.camera_from_cloud.translation() = -(camera.camera_from_cloud.linear() * origin);

  std::vector<double> slopes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = camera.camera_from_cloud * cloud.point(i).cast<double>();
    if (p.z() > kNear) {
      slopes.push_back(std::max(std::abs(p.x() / p.z()) * 3 / 4, std::abs(p.y() / p.z())));
    }
  }
  if (!slopes.empty()) {
    const auto most = slopes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(slopes.size() - 1));
    std::nth_element(slopes.begin(), most, slopes.end());
    camera.intrinsics.fx = camera.intrinsics.fy = camera.intrinsics.cy / std::clamp(*most, 0.05, 2.0);
  }
  return camera;
}

}  // namespace

std::optional<Eigen::Vector2d> PictureCamera::project(const Eigen::Vector3d& p) const
{
  if (!(p.z() > kNear)) {
    return std::nullopt;
  }
  return Eigen::Vector2d(intrinsics.fx * p.x() / p.z() + intrinsics.cx, intrinsics.fy * p.y() / p.z() + intrinsics.cy);
}

PictureCamera pictureCamera(const Cloud& cloud)
{
  UsableCloud usable;
  usable.update(cloud);
  if (!usable.image()) {
    return virtualCamera(cloud);
  }
  PictureCamera camera;
  camera.intrinsics = usable.image()->intrinsics();
  camera.width = cloud.width;
  camera.height = cloud.height;
  camera.is_sensor = true;
  return camera;
}

}  // namespace grasp_affordances
