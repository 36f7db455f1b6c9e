#pragma once

#include "io/bag.h"
#include "support/test_with_folder.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

namespace grasp_affordances::test
{

inline sensor_msgs::PointCloud2 makeMessage(std::uint32_t width)
{
  sensor_msgs::PointCloud2 message;
  message.header.frame_id = "camera";
  message.header.stamp = ros::Time(100 + width, 5);
  message.width = width;
  message.height = 1;
  message.point_step = 12;
  message.row_step = 12 * width;
  for (const char* name : {"x", "y", "z"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = 4 * static_cast<std::uint32_t>(message.fields.size());
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    message.fields.push_back(field);
  }
  for (std::uint32_t i = 0; i < 3 * width; ++i) {
    const float value = 1.0F + i;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    message.data.insert(message.data.end(), bytes, bytes + sizeof(value));
  }
  return message;
}

class BagTest : public TestWithFolder
{
protected:
  std::string path(const std::string& name = "clouds.bag") const { return folder_ / name; }

  /// Three clouds on /points and a word on /word; two clouds on /other, if wanted.
  std::string writeBag(bool other, rosbag::CompressionType compression = rosbag::compression::Uncompressed)
  {
    rosbag::Bag bag;
    bag.open(path(), rosbag::bagmode::Write);
    bag.setCompression(compression);
    std_msgs::String word;
    word.data = "hello";
    bag.write("/word", ros::Time(1), word);
    for (std::uint32_t i = 1; i <= 3; ++i) {
      bag.write("/points", ros::Time(10 + i), makeMessage(i));
      if (other && i > 1) {
        bag.write("/other", ros::Time(10 + i), makeMessage(10 + i));
      }
    }
    bag.close();
    return path();
  }

  /// "width" for each cloud, "(reason)" for each malformed message.
  static std::string read(const std::string& path, const std::string& topic = "")
  {
    std::ostringstream seen;
    BagVisitor visitor;
    visitor.cloud = [&](const sensor_msgs::PointCloud2& message, std::size_t index, std::size_t count) {
      EXPECT_LT(index, count);
      seen << message.width << " ";
    };
    visitor.malformed = [&](const std::string& reason, std::size_t, std::size_t) { seen << "(" << reason << ") "; };
    readBagClouds(path, topic, visitor);
    return seen.str();
  }

  void expectRefused(const std::string& path, const std::string& topic, const std::string& reason)
  {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    std::string message = "nothing was thrown";
    try {
      read(path, topic);
    } catch (const CloudError& error) {
      message = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
    EXPECT_NE(message.find(reason), std::string::npos) << "expected '" << reason << "', got '" << message << "'";
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }

  static std::string content(const std::string& path)
  {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  std::string writeFile(const std::string& text)
  {
    std::ofstream(path("changed.bag"), std::ios::binary) << text;
    return path("changed.bag");
  }
};

}  // namespace grasp_affordances::test
