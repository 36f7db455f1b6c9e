#include "io/bag.h"
#include "support/bags.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <cstddef>
#include <cstring>
#include <string>

namespace grasp_affordances
{
namespace
{

using namespace test;

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
