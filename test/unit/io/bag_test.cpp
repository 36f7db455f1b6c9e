#include "io/bag.h"
#include "support/bags.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/query.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <boost/make_shared.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

namespace grasp_affordances
{
namespace
{

using namespace test;

/// With it librosbag makes connections by header, not by topic.
template <class Message>
boost::shared_ptr<ros::M_string> connectionOf(const Message& message)
{
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = ros::message_traits::definition(message);
  return header;
}

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

/// Topics of recorders that are no nodes of ROS, and of relays of other systems.
TEST_F(BagTest, readsTopicsThatAreNoNamesOfRos)
{
  std_msgs::String word;
  for (const std::string& odd :
       {std::string("/my points"), std::string("T\u00fcr/Punkte"), std::string("/\u70b9\u7fa4"),
        std::string("a, 'b' \xff\xc2\x9b"), std::string(400, 'x')}) {
    SCOPED_TRACE(odd);
    rosbag::Bag bag;
    bag.open(path(), rosbag::bagmode::Write);
    bag.write(odd + "/word", ros::Time(1), word);
    bag.write(odd, ros::Time(2), makeMessage(7));
    bag.close();
    EXPECT_EQ(read(path()), "7 ");
    EXPECT_EQ(read(path(), odd), "7 ");
    expectRefused(path(), odd + "/word", "holds std_msgs/String");
    expectRefused(path(), odd + "/other", "the bag has no topic ");
    bag.open(path(), rosbag::bagmode::Append);
    bag.write("/points", ros::Time(3), makeMessage(8));
    bag.close();
    EXPECT_EQ(read(path(), odd), "7 ");
    EXPECT_EQ(read(path(), "/points"), "8 ");
    expectRefused(path(), "", "choose one: ");
  }
}

TEST_F(BagTest, quotesTopicsThatAreNoNamesOfRos)
{
  rosbag::Bag bag;
  bag.open(path(), rosbag::bagmode::Write);
  bag.write("/my points", ros::Time(1), makeMessage(1));
  bag.write("/points", ros::Time(2), makeMessage(2));
  bag.write("/r\xff", ros::Time(3), makeMessage(3));
  bag.close();
  expectRefused(path(), "", "choose one: '/my points', /points, '/r\\xff'");
}

/// A topic of two types: the clouds on it are read.
TEST_F(BagTest, readsTheCloudsOfATopicThatHoldsOtherMessagesToo)
{
  rosbag::Bag bag;
  bag.open(path(), rosbag::bagmode::Write);
  std_msgs::String word;
  bag.write("/points", ros::Time(1), makeMessage(1), connectionOf(makeMessage(1)));
  bag.write("/points", ros::Time(2), word, connectionOf(word));
  bag.write("/points", ros::Time(3), makeMessage(2), connectionOf(makeMessage(2)));
  bag.close();
  EXPECT_EQ(read(path()), "1 2 ");
  EXPECT_EQ(read(path(), "/points"), "1 2 ");
}

/// Small chunks, two topics, times that go back.
TEST_F(BagTest, readsWhatLibrosbagReads)
{
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    SCOPED_TRACE(compression);
    constexpr std::uint32_t kMessages = 40;
    rosbag::Bag bag;
    bag.open(path(), rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(2000);
    for (std::uint32_t i = 0; i < kMessages; ++i) {
      bag.write(i % 3 == 0 ? "/other" : "/points", ros::Time(10 + i * 7 % kMessages), makeMessage(1 + i));
    }
    bag.close();
    bag.open(path(), rosbag::bagmode::Read);
    for (const char* topic : {"/points", "/other"}) {
      std::ostringstream expected;
      rosbag::View view(bag, rosbag::TopicQuery(topic));
      EXPECT_GE(view.size(), kMessages / 3);
      for (const rosbag::MessageInstance& instance : view) {
        expected << instance.instantiate<sensor_msgs::PointCloud2>()->width << " ";
      }
      EXPECT_EQ(read(path(), topic), expected.str());
    }
    bag.close();
  }
}

/// A long bag is not silent: its first cloud comes before the rest is unpacked.
TEST_F(BagTest, visitsCloudsBeforeItUnpacksLaterChunks)
{
  rosbag::Bag bag;
  bag.open(path(), rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::BZ2);
  bag.setChunkThreshold(1);  // a chunk for each message
  for (std::uint32_t i = 1; i <= 3; ++i) {
    bag.write("/points", ros::Time(i), makeMessage(i));
  }
  bag.close();
  std::string text = content(path());
  const std::size_t last = text.rfind("BZh");
  ASSERT_NE(last, std::string::npos);
  ASSERT_NE(last, text.find("BZh"));
  text.replace(last + 4, 6, "damage");
  std::ostringstream seen;
  BagVisitor visitor;
  visitor.cloud = [&](const sensor_msgs::PointCloud2& message, std::size_t, std::size_t count) {
    seen << message.width << "/" << count << " ";
  };
  visitor.malformed = [](const std::string& reason, std::size_t, std::size_t) { ADD_FAILURE() << reason; };
  EXPECT_THROW(readBagClouds(writeFile(text), "", visitor), CloudError);
  EXPECT_EQ(seen.str(), "1/3 2/3 ");
}

TEST_F(BagTest, isKnownByItsFirstBytes)
{
  EXPECT_TRUE(isBag(writeBag(false)));
  EXPECT_TRUE(isBag(writeFile("#ROSBAG V1.2\n")));
  for (const char* text : {"", "#ROS", "#ROSBAG 2", "hello world\n", "# .PCD v0.7\n"}) {
    EXPECT_FALSE(isBag(writeFile(text))) << text;
  }
  EXPECT_FALSE(isBag(path("missing.bag")));
  EXPECT_FALSE(isBag(folder_));
  EXPECT_FALSE(isBag("/dev/null"));
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
  expectRefused(writeFile(text), "", "was not closed");
  expectRefused(writeFile(text), "", "rosbag reindex");
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
