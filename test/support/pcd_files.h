#pragma once

#include "grasp_affordances/cloud.h"
#include "support/test_with_folder.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace grasp_affordances::test
{

/// The lines of a PCD header; a test changes some.
struct Header
{
  std::string fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  std::string extent = "WIDTH 2\nHEIGHT 1\n";
  std::string viewpoint = "VIEWPOINT 0 0 0 1 0 0 0\n";
  std::string points = "POINTS 2\n";
  std::string data = "DATA binary\n";

  std::string text() const
  {
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + extent + viewpoint + points + data;
  }
};

inline std::string bytes(const std::vector<float>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

inline std::string bytes(std::uint32_t value)
{
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// An LZF block of up to 32 literal bytes, behind its sizes.
inline std::string block(const std::string& raw)
{
  return bytes(static_cast<std::uint32_t>(raw.size() + 1)) + bytes(static_cast<std::uint32_t>(raw.size())) +
         static_cast<char>(raw.size() - 1) + raw;
}

class PcdTest : public TestWithFolder
{
protected:
  std::string write(const std::string& content)
  {
    const std::string path = folder_ / "cloud.pcd";
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
};

inline const std::string kTwoPoints = bytes({1, 2, 3, 4, 5, 6});
inline const std::string kTwoPointsByField = bytes({1, 4, 2, 5, 3, 6});

inline void expectTwoPoints(const Cloud& cloud)
{
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.point(0), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.point(1), Eigen::Vector3f(4, 5, 6));
}

}  // namespace grasp_affordances::test
