#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/point_cloud2.h"

#include <pcl/PCLPointCloud2.h>
#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace grasp_affordances
{

/// Pose of a sensor's frame in another frame, as in a file or an option.
struct SensorPose
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  /// The transform from the sensor's frame to the other frame. Empty if the quaternion's length differs from 1 by more
  /// than 1e-3; rounded digits are within that.
  std::optional<Eigen::Isometry3d> transform() const;

  /// The position (m) as that of a sensor. Empty for a pose without a shift and without a turn: files have it where
  /// nobody knew any.
  std::optional<Eigen::Vector3f> sensorOrigin() const;
};

/// Reads a PCD file with any fields: ascii, binary or binary_compressed. The header is compared with the file's size
/// before memory is allocated. Header lines of an unknown key are skipped, and blank lines between the points.
/// @param viewpoint if given, receives the header's VIEWPOINT (tx ty tz qw qx qy qz). Its meaning differs between
/// files. In some the points are in the sensor's frame, and VIEWPOINT is the pose of that frame in the scene. In others
/// the points are in the scene's frame already, and only the position counts: that of the sensor.
/// @throw CloudError, without the path in its text, if the file is not a complete PCD file.
pcl::PCLPointCloud2 readPcd(const std::string& path, SensorPose* viewpoint = nullptr);

/// As readPcd, but reads only the coordinates, and SensorPose::sensorOrigin() of VIEWPOINT.
/// @throw CloudError as readPcd, and if the file has no fields x, y, z.
Cloud readPcdCloud(const std::string& path);

}  // namespace grasp_affordances
