#pragma once

#include "grasp_affordances/cloud.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>

namespace grasp_affordances
{

/// A pinhole camera that looks at a cloud.
struct PictureCamera
{
  PinholeIntrinsics intrinsics;
  Eigen::Isometry3d camera_from_cloud = Eigen::Isometry3d::Identity();  ///< camera: x right, y down, z forward
  std::uint32_t width = 0;                                              ///< pixels
  std::uint32_t height = 0;                                             ///< pixels
  bool is_sensor = false;  ///< this camera measured the cloud, so that each point has its own pixel

  /// Pixel coordinates of a point in the camera's frame. Empty if it is not in front of the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera) const;
};

/// The camera that measured the cloud, if the cloud's points reproject to their pixels. Otherwise a camera at the
/// sensor's origin that looks at the middle of the points and sees most of them. Where the sensor's place is not known,
/// that camera is at the origin, or outside the points if the origin is among them.
PictureCamera pictureCamera(const Cloud& cloud);

}  // namespace grasp_affordances
