#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/point_cloud2.h"

#include <pcl/PCLPointCloud2.h>

#include <string>

namespace grasp_affordances
{

/// Reads a PCD file of any field layout: ascii, binary or binary_compressed. The header is checked against the size of
/// the file before anything that it promises is allocated.
/// @param sensor_origin if given, receives the translation of the header's VIEWPOINT: where the sensor stood, in metres
/// in the frame of the points. Its rotation has no use here.
/// @throw CloudError, without the path, for a file that is no complete PCD file.
pcl::PCLPointCloud2 readPcd(const std::string& path, Eigen::Vector3f* sensor_origin = nullptr);

/// As readPcd, with the coordinates and the sensor's origin only. @throw CloudError also for a file without x, y, z.
Cloud readPcdCloud(const std::string& path);

}  // namespace grasp_affordances
