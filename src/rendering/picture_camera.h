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
  bool is_sensor = false;  ///< it measured the cloud: each point has a pixel of its own

  /// Pixel coordinates of a point in the camera's frame; empty where it is not in front of the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera) const;
};

/// The camera that measured the cloud, where its points reproject to their pixels. Otherwise a camera at the sensor's
/// origin that looks at the middle of the points and takes most of them in.
PictureCamera pictureCamera(const Cloud& cloud);

}  // namespace grasp_affordances
