#pragma once

#include "cli/command_line_test.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace grasp_affordances::test
{

using Json = nlohmann::json;

inline std::vector<std::string> lines(const std::string& text)
{
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    result.push_back(line);
  }
  return result;
}

/// How a call of `localize` ended.
struct Call
{
  int status;
  std::string out, err;

  std::vector<Json> json() const
  {
    std::vector<Json> clouds;
    for (const std::string& line : lines(out)) {
      clouds.push_back(Json::parse(line));
    }
    return clouds;
  }
};

class LocalizeTest : public CommandLineTest
{
protected:
  /// @param limits  shell command before the call
  Call localize(const std::string& arguments, const std::string& limits = "true") const
  {
    const int status = run(limits + " && exec " LOCALIZE " " + arguments);
    return {status, content("stdout"), content("stderr")};
  }

  template <typename PointT>
  std::string write(const std::string& name, const pcl::PointCloud<PointT>& points) const
  {
    pcl::PCDWriter().writeBinary(path(name), points);
    return name;
  }

  std::string writeText(const std::string& name, const std::string& text) const
  {
    std::ofstream(path(name), std::ios::binary) << text;
    return name;
  }

  static pcl::PointCloud<pcl::PointXYZ> table()
  {
    const Cloud cloud = captureScene("table", 3).cloud;
    pcl::PointCloud<pcl::PointXYZ> points(cloud.width, cloud.height);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].getVector3fMap() = cloud.point(i);
    }
    return points;
  }

  /// The measured points of a cloud only.
  static pcl::PointCloud<pcl::PointXYZ> unorganized(const pcl::PointCloud<pcl::PointXYZ>& points)
  {
    pcl::PointCloud<pcl::PointXYZ> result;
    std::copy_if(points.begin(), points.end(), std::back_inserter(result),
                 [](const pcl::PointXYZ& point) { return std::isfinite(point.z); });
    return result;
  }
};

}  // namespace grasp_affordances::test
