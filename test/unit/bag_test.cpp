#include "io/bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace grasp_affordances
{
namespace
{

sensor_msgs::PointCloud2 makeMessage(std::uint32_t width)
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

class BagTest : public testing::Test
{
protected:
  BagTest() { std::filesystem::create_directories(folder_); }
  ~BagTest() override { std::filesystem::remove_all(folder_); }

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

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("bag_test_" + std::to_string(::getpid()));
};

TEST_F(BagTest, readsTheOnlyTopic)
{
  EXPECT_EQ(read(writeBag(false)), "1 2 3 ");
  EXPECT_EQ(read(writeBag(false, rosbag::compression::BZ2)), "1 2 3 ");
  EXPECT_EQ(read(writeBag(false, rosbag::compression::LZ4)), "1 2 3 ");
}

TEST_F(BagTest, keepsHeaderAndData)
{
  BagVisitor visitor;
  std::size_t visited = 0;
  visitor.cloud = [&](const sensor_msgs::PointCloud2& message, std::size_t index, std::size_t count) {
    EXPECT_EQ(index, visited++);
    EXPECT_EQ(count, 3U);
    EXPECT_EQ(message.header.frame_id, "camera");
    EXPECT_EQ(message.header.stamp, ros::Time(101 + index, 5));
    Cloud cloud;
    cloudFromPointCloud2(message, cloud);
    EXPECT_EQ(cloud.point(index), Eigen::Vector3f(1.0F + 3 * index, 2.0F + 3 * index, 3.0F + 3 * index));
  };
  visitor.malformed = [](const std::string& reason, std::size_t, std::size_t) { ADD_FAILURE() << reason; };
  readBagClouds(writeBag(false), "", visitor);
  EXPECT_EQ(visited, 3U);
}

TEST_F(BagTest, choosesAmongTopics)
{
  const std::string bag = writeBag(true);
  EXPECT_EQ(read(bag, "/points"), "1 2 3 ");
  EXPECT_EQ(read(bag, "/other"), "12 13 ");
  expectRefused(bag, "", "several topics of sensor_msgs/PointCloud2, choose one: /other, /points");
  expectRefused(bag, "/nowhere", "no topic /nowhere; its topics of sensor_msgs/PointCloud2: /other, /points");
  expectRefused(bag, "/word", "holds std_msgs/String");
}

TEST_F(BagTest, refusesBagsWithoutClouds)
{
  rosbag::Bag bag;
  bag.open(path(), rosbag::bagmode::Write);
  std_msgs::String word;
  bag.write("/word", ros::Time(1), word);
  bag.close();
  expectRefused(path(), "", "no topic of sensor_msgs/PointCloud2");
  bag.open(path("empty.bag"), rosbag::bagmode::Write);
  bag.close();
  expectRefused(path("empty.bag"), "", "no topic of sensor_msgs/PointCloud2");
}

TEST_F(BagTest, refusesWhatIsNoBag)
{
  expectRefused(path("missing.bag"), "", "cannot be read as a bag");
  expectRefused(folder_, "", "is a folder");
  expectRefused(writeFile(""), "", "cannot be read as a bag");
  expectRefused(writeFile("hello world\n"), "", "cannot be read as a bag");
  const std::string whole = content(writeBag(false));
  for (const std::size_t size : {20UL, 100UL, 4200UL, whole.size() / 2, whole.size() - 100, whole.size() - 1}) {
    SCOPED_TRACE(size);
    expectRefused(writeFile(whole.substr(0, size)), "", "bag");
  }
}

TEST_F(BagTest, refusesBagsWithoutIndex)
{
  std::string text = content(writeBag(false));
  const std::size_t at = text.find("index_pos=");
  ASSERT_NE(at, std::string::npos);
  std::memset(&text[at + 10], 0, 8);
  expectRefused(writeFile(text), "", "no index");
}

/// The second message claims more of something than it holds; the others are still read.
TEST_F(BagTest, goesOnAfterAMalformedMessage)
{
  const std::string good = content(writeBag(false));
  const std::string header = std::string("\x06\0\0\0camera", 10);
  std::size_t at = 0;
  for (int message = 0; message < 2; ++message) {
    at = good.find(header, at + 1);
    ASSERT_NE(at, std::string::npos);
  }
  const std::size_t fields = at + header.size() + 8;
  const std::size_t data = fields + 4 + 3 * (4 + 1 + 9) + 9;
  for (const std::size_t length : {at, fields, fields + 4, data}) {
    for (const char* claim : {"\x40\x42\x0f\0", "\xff\xff\xff\xff"}) {
      std::string text = good;
      text.replace(length, 4, std::string(claim, 4));
      EXPECT_EQ(read(writeFile(text)), "1 (the message of 114 bytes is shorter than it claims) 3 ") << length - at;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances
