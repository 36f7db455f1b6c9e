#include "io/bag.h"
#include "support/bags.h"
#include "support/sanitizers.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace grasp_affordances
{
namespace
{

using namespace test;

/// Lets this process have so many bytes of memory more than it has, touched or not, as long as it exists.
class MemoryLimit
{
public:
  explicit MemoryLimit(std::size_t more)
  {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    ::getrlimit(RLIMIT_AS, &before_);
    const rlimit limit{pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + more, before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
  rlimit before_{};
};

/// A bag's bytes, with a number in it changed.
std::string changed(const std::string& bag, std::size_t at, const std::string& bytes)
{
  std::string text = bag;
  EXPECT_LE(at + bytes.size(), bag.size());
  return text.replace(at, bytes.size(), bytes);
}

/// Behind the first text `key` that follows the first text `after`.
std::size_t behind(const std::string& bag, const std::string& key, const std::string& after = "#ROSBAG")
{
  const std::size_t found = bag.find(key, bag.find(after));
  EXPECT_NE(found, std::string::npos) << key;
  return found + key.size();
}

const std::string kHuge = "\xff\xff\xff\x7f";
const std::string kIndexData = "op=\x04";

/// What librosbag takes on trust: each of these would have it read beyond a buffer, or use what is not there.
TEST_F(BagTest, refusesNumbersThatLie)
{
  const std::string good = content(writeBag(false));
  const auto lie = [&](std::size_t at, const std::string& bytes, const std::string& reason) {
    SCOPED_TRACE(reason);
    expectRefused(writeFile(changed(good, at, bytes)), "", reason);
  };
  const std::size_t header = std::string("#ROSBAG V2.0\n").size();
  lie(header, kHuge, "the header of the bag reaches beyond its end");
  lie(header + 4, kHuge, "a field reaches beyond its header");
  lie(behind(good, "index_pos="), std::string("\xff\xff\xff\xff\xff\xff\xff\xff"), "reaches beyond its end");
  lie(behind(good, "conn_count="), kHuge, "there is no a connection");
  lie(behind(good, "chunk_count="), kHuge, "reaches beyond its end");
  lie(behind(good, "chunk_pos="), std::string(8, '\0'), "reaches beyond its end");
  lie(behind(good, "compression=") - 13, kHuge, "a field reaches beyond its header");
  lie(behind(good, "size="), kHuge, "a chunk is not as long as it claims");
  lie(behind(good, "count=", "ver="), kHuge, "is not as long as it claims");
}

/// An index whose connection is not declared.
TEST_F(BagTest, refusesAnIndexOfNoConnection)
{
  const std::string good = content(writeBag(false));
  const std::size_t index = good.find(kIndexData);
  ASSERT_NE(index, std::string::npos);
  const std::size_t connection = good.rfind("conn=", index) + 5;
  ASSERT_LT(index - connection, 40U) << "fields of one header, by name";
  expectRefused(writeFile(changed(good, connection, kHuge)), "", "an index belongs to no connection");
}

TEST_F(BagTest, refusesMessagesThatAreNotThere)
{
  const std::string good = content(writeBag(false));
  // The last entry of the index before the connections: seconds, nanoseconds, place.
  std::uint64_t index_position = 0;
  std::memcpy(&index_position, &good[behind(good, "index_pos=")], sizeof(index_position));
  const std::size_t entry = index_position - 12;
  expectRefused(writeFile(changed(good, entry + 8, kHuge)), "", "a message reaches beyond its end");
  expectRefused(writeFile(changed(good, entry + 8, good.substr(entry - 4, 4))), "", "messages overlap");
  expectRefused(writeFile(changed(good, entry + 4, kHuge)), "", "a message has no time");
  const std::size_t length = good.rfind(std::string("\x06\0\0\0camera", 10)) - 12 - 4;
  expectRefused(writeFile(changed(good, length, kHuge)), "", "a message reaches beyond its end");
}

/// A chunk in which nothing is of interest is read, too.
TEST_F(BagTest, refusesAChunkWithoutItsFields)
{
  std::string words = content(writeBag(false));
  for (std::size_t at = words.find("/PointCloud2"); at != std::string::npos; at = words.find("/PointCloud2")) {
    words.replace(at, 12, "/PointCloud3");
  }
  expectRefused(writeFile(words), "", "the bag has no topic of sensor_msgs/PointCloud2");
  expectRefused(writeFile(changed(words, words.find("compression="), "compassion=")), "",
                "a header has no field compression");
  expectRefused(writeFile(changed(words, words.find("size="), "syze=")), "", "a header has no field size");
}

/// roslz4 copies a block into a buffer of the size that the frame's header names.
TEST_F(BagTest, refusesLz4BlocksThatAreTooLarge)
{
  const std::string good = content(writeBag(false, rosbag::compression::LZ4));
  const std::size_t frame = good.find(std::string("\x04\x22\x4d\x18", 4));
  ASSERT_NE(frame, std::string::npos);
  for (const std::string& size : {kHuge, std::string("\xff\xff\xff\xff"), std::string("\x01\x00\x50\x00", 4)}) {
    expectRefused(writeFile(changed(good, frame + 7, size)), "", "an LZ4 block is too large");
  }
  expectRefused(writeFile(changed(good, frame + 5, std::string(1, '\0'))), "", "an LZ4 frame has no block size");
}

TEST_F(BagTest, refusesChunksThatDoNotUnpack)
{
  for (const rosbag::CompressionType compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string good = content(writeBag(false, compression));
    const std::size_t size = behind(good, "size=");
    expectRefused(writeFile(changed(good, size, "\xff")), "", "a chunk does not unpack to what it claims");
    expectRefused(writeFile(changed(good, size, kHuge)), "", "a compressed chunk claims more than 1 GiB");
    expectRefused(writeFile(changed(good, size + 40, "????")), "", "damaged");
  }
}

/// Compressed, so small a file can hold so much; what it can is bounded before memory is asked for.
TEST_F(BagTest, asksForNoMemoryThatAChunkOnlyClaims)
{
  if (GRASP_AFFORDANCES_SANITIZER != 0) {
    GTEST_SKIP() << "a sanitizer reserves more memory than a limit would allow";
  }
  for (const rosbag::CompressionType compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string good = content(writeBag(false, compression));
    const std::string file = writeFile(changed(good, behind(good, "size="), std::string("\0\0\0\x40", 4)));
    const MemoryLimit limit(200'000'000);
    expectRefused(file, "", "a chunk does not unpack to what it claims");
  }
}

/// A field takes several times the memory that it has in the message.
TEST_F(BagTest, refusesMessagesOfVeryManyFields)
{
  sensor_msgs::PointCloud2 message = makeMessage(1);
  message.fields.resize(1000, message.fields[0]);
  sensor_msgs::PointCloud2 more = message;
  more.fields.push_back(more.fields[0]);
  {
    rosbag::Bag bag(path(), rosbag::bagmode::Write);
    bag.write("/points", ros::Time(1), message);
    bag.write("/points", ros::Time(2), more);
  }
  EXPECT_EQ(read(path()), "1 (the message has 1001 fields, more than 1000) ");
}

TEST_F(BagTest, refusesOtherBags)
{
  expectRefused(writeFile("#ROSBAG V1.2\n"), "", "older than version 2.0");
  expectRefused(writeFile("#ROS" + std::string(1000, 'x') + " V2.0\n"), "", "cannot be read as a bag");
  std::string encrypted = content(writeBag(false));
  const std::string field = std::string("\x0b\0\0\0encryptor=x", 15);
  const std::size_t header = std::string("#ROSBAG V2.0\n").size();
  std::uint32_t length = 0;
  std::memcpy(&length, &encrypted[header], sizeof(length));
  encrypted.insert(header + 4 + length, field);
  length += static_cast<std::uint32_t>(field.size());
  std::memcpy(&encrypted[header], &length, sizeof(length));
  expectRefused(writeFile(encrypted), "", "encrypted");
}

TEST_F(BagTest, refusesNamesThatCannotBePrinted)
{
  const std::string good = content(writeBag(true));
  const std::size_t topic = good.rfind("topic=/points") + 6;
  expectRefused(writeFile(changed(good, topic, "\n")), "", "the topic of a connection is not a valid name");
  const std::size_t type = good.rfind("type=sensor_msgs/PointCloud2") + 5;
  expectRefused(writeFile(changed(good, type, "\x1b")), "", "the type of a connection is not a valid name");
}

/// A byte of a bag, or four, changed at random: it is read or refused.
TEST_F(BagTest, survivesChangedBytes)
{
  constexpr std::uint32_t kSeed = 1, kTries = 100;
  std::mt19937 random(kSeed);
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string good = content(writeBag(false, compression));
    const std::size_t padding = good.find("    "), begin = good.find_first_not_of(' ', padding);
    std::size_t refused = 0;
    for (std::uint32_t i = 0; i < kTries; ++i) {
      const std::size_t place = random() % (good.size() - (begin - padding) - 4);
      std::string bytes(1 + 3 * (random() % 2), static_cast<char>(random()));
      try {
        read(writeFile(changed(good, place < padding ? place : place + begin - padding, bytes)));
      } catch (const CloudError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 0U) << "most of a bag that is not compressed are texts";
    EXPECT_LT(refused, kTries);
  }
}

}  // namespace
}  // namespace grasp_affordances
