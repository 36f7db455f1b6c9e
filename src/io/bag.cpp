#include "io/bag.h"

#include "io/bag_file.h"
#include "io/content_kind.h"
#include "io/printable.h"

#include <ros/serialization.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <set>
#include <system_error>
#include <vector>

namespace grasp_affordances
{
namespace
{

const char* const kType = "sensor_msgs/PointCloud2";

/// A PointCloud2 message as recorded bytes. Its lengths are checked before roscpp allocates memory for them.
class SerializedCloud
{
public:
  explicit SerializedCloud(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void deserialize(sensor_msgs::PointCloud2& message)
  {
    skip(4 + 8);     // seq, stamp
    skip(length());  // frame_id
    skip(4 + 4);     // height, width
    const std::uint32_t fields = length();
    for (std::uint32_t i = 0; i < fields; ++i) {
      skip(length());   // name
      skip(4 + 1 + 4);  // offset, datatype, count
    }
    skip(1 + 4 + 4);  // is_bigendian, point_step, row_step
    skip(length());   // data
    skip(1);          // is_dense
    if (fields > kMostFields) {
      throw CloudError("the message has " + std::to_string(fields) + " fields, more than " +
                       std::to_string(kMostFields));
    }
    ros::serialization::IStream stream(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
    ros::serialization::deserialize(stream, message);
  }

private:
  static constexpr std::uint32_t kMostFields = 1000;  // in memory a field takes several times its bytes in the message

  std::uint32_t length()
  {
    const std::size_t at = position_;
    skip(sizeof(std::uint32_t));
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + at, sizeof(value));
    return value;
  }

  void skip(std::size_t size)
  {
    if (size > bytes_.size() - position_) {
      throw CloudError("the message of " + std::to_string(bytes_.size()) + " bytes is shorter than it claims");
    }
    position_ += size;
  }

  std::vector<std::uint8_t>& bytes_;
  std::size_t position_ = 0;
};

/// As a shell takes it: in quotes where it is no name of ROS.
std::string shownTopic(const std::string& topic)
{
  constexpr std::size_t kLongest = 200;
  const bool plain = std::all_of(topic.begin(), topic.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '_';
  });
  const std::string text = printable(topic, kLongest);
  return plain && !topic.empty() ? text : "'" + text + "'";
}

std::string join(const std::set<std::string>& topics)
{
  constexpr std::size_t kLongest = 500;
  std::string text;
  for (const std::string& topic : topics) {
    const std::string shown = shownTopic(topic);
    if (text.size() + shown.size() > kLongest) {
      return text + ", ...";
    }
    text += (text.empty() ? "" : ", ") + shown;
  }
  return text;
}

std::string chooseTopic(const BagFile& bag, const std::string& wanted)
{
  std::set<std::string> topics;
  std::string other_type;  // of the topic that is wanted
  for (const auto& [number, connection] : bag.connections()) {
    if (connection.type == kType && connection.messages > 0) {
      topics.insert(connection.topic);
    } else if (connection.type != kType && connection.topic == wanted) {
      other_type = connection.type;
    }
  }
  if (!wanted.empty() && topics.count(wanted) != 0) {
    return wanted;
  }
  if (!wanted.empty() && !other_type.empty()) {
    throw CloudError("topic " + shownTopic(wanted) + " holds " + printable(other_type) + ", not " + kType);
  }
  if (topics.empty()) {
    throw CloudError(std::string("the bag has no topic of ") + kType);
  }
  if (!wanted.empty()) {
    throw CloudError("the bag has no topic " + shownTopic(wanted) + "; its topics of " + kType + ": " + join(topics));
  }
  if (topics.size() > 1) {
    throw CloudError("the bag has several topics of " + std::string(kType) + ", choose one: " + join(topics));
  }
  return *topics.begin();
}

/// The messages of a topic in the order of recording.
std::vector<BagEntry> messagesOf(const BagFile& bag, const std::string& topic)
{
  std::vector<BagEntry> messages;
  std::copy_if(bag.entries().begin(), bag.entries().end(), std::back_inserter(messages),
               [&](const BagEntry& entry) { return bag.connections().at(entry.connection).topic == topic; });
  std::stable_sort(messages.begin(), messages.end(),
                   [](const BagEntry& a, const BagEntry& b) { return a.time < b.time; });
  return messages;
}

void readMessage(const BagConnection& connection, std::vector<std::uint8_t>& bytes, sensor_msgs::PointCloud2& message)
{
  if (connection.md5sum != ros::message_traits::md5sum<sensor_msgs::PointCloud2>()) {
    throw CloudError(std::string("the message is of another version of ") + kType);
  }
  SerializedCloud(bytes).deserialize(message);
}

void visitMessages(BagFile& bag, const std::vector<BagEntry>& messages, const BagVisitor& visitor)
{
  std::vector<std::uint8_t> bytes;
  sensor_msgs::PointCloud2 message;
  for (std::size_t index = 0; index < messages.size(); ++index) {
    const BagEntry& entry = messages[index];
    bag.read(entry, bytes);
    std::string reason;
    try {
      readMessage(bag.connections().at(entry.connection), bytes, message);
    } catch (const std::exception& error) {
      reason = error.what();
    }
    if (reason.empty()) {
      visitor.cloud(message, index, messages.size());
    } else {
      visitor.malformed(reason, index, messages.size());
    }
  }
}

}  // namespace

bool isBag(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {  // the first bytes of a pipe could be read once only
    return false;
  }
  std::string begin(std::strlen(kBagMagic), '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == kBagMagic;
}

void readBagClouds(const std::string& path, const std::string& topic, const BagVisitor& visitor)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw CloudError(std::filesystem::is_directory(status) ? "is a folder" : "is no regular file");
  }
  try {
    BagFile bag(path, kType);
    visitMessages(bag, messagesOf(bag, chooseTopic(bag, topic)), visitor);
  } catch (const std::bad_alloc&) {
    throw CloudError("the bag asks for more memory than there is");
  }
}

}  // namespace grasp_affordances
