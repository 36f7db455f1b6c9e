#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/point_cloud2.h"

#include <pcl/PCLPointCloud2.h>
#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace grasp_affordances
{

/// Pose of a sensor as it is written down: the frame of its points in another one.
struct SensorPose
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  /// Takes a point from the sensor's frame to the other. Empty for a quaternion whose length is not 1 within 1e-3,
  /// which leaves room for rounded digits.
  std::optional<Eigen::Isometry3d> transform() const;
};

/// Reads a PCD file of any field layout: ascii, binary or binary_compressed. The header is checked against the size of
/// the file before anything that it promises is allocated.
/// @param viewpoint if given, receives the header's VIEWPOINT (tx ty tz qw qx qy qz). Files differ in what they mean by
/// it: the points are in the sensor's frame, and this takes them to that of the scene; or they are there already, and
/// its position is where the sensor stood.
/// @throw CloudError, without the path, for a file that is no complete PCD file.
pcl::PCLPointCloud2 readPcd(const std::string& path, SensorPose* viewpoint = nullptr);

/// As readPcd, with the coordinates and, as the sensor's origin, the position of VIEWPOINT only. @throw CloudError also
/// for a file without x, y, z.
Cloud readPcdCloud(const std::string& path);

}  // namespace grasp_affordances
