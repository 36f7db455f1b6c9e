#include "io/bag.h"

#include "io/bag_check.h"

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/query.h>
#include <rosbag/view.h>

#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
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

std::string join(const std::vector<std::string>& words)
{
  constexpr std::size_t kLongest = 500;
  std::string text;
  for (const std::string& word : words) {
    if (text.size() + word.size() > kLongest) {
      return text + ", ...";
    }
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string chooseTopic(const rosbag::Bag& bag, const std::string& wanted)
{
  std::map<std::string, std::string> types;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    types[connection->topic] = connection->datatype;
  }
  std::vector<std::string> topics;
  for (const auto& [topic, type] : types) {
    if (type == kType) {
      topics.push_back(topic);
    }
  }
  const auto found = types.find(wanted);
  if (!wanted.empty() && found != types.end() && found->second != kType) {
    throw CloudError("topic " + wanted + " holds " + found->second + ", not " + kType);
  }
  if (topics.empty()) {
    throw CloudError(std::string("the bag has no topic of ") + kType);
  }
  if (!wanted.empty() && found == types.end()) {
    throw CloudError("the bag has no topic " + wanted + "; its topics of " + kType + ": " + join(topics));
  }
  if (wanted.empty() && topics.size() > 1) {
    throw CloudError("the bag has several topics of " + std::string(kType) + ", choose one: " + join(topics));
  }
  return wanted.empty() ? topics.front() : wanted;
}

void readMessage(const rosbag::MessageInstance& instance, std::vector<std::uint8_t>& bytes,
                 sensor_msgs::PointCloud2& message)
{
  if (instance.getMD5Sum() != ros::message_traits::md5sum<sensor_msgs::PointCloud2>()) {
    throw CloudError(std::string("the message is of another version of ") + kType);
  }
  bytes.resize(instance.size());
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  instance.write(stream);
  SerializedCloud(bytes).deserialize(message);
}

void visitMessages(rosbag::View& view, const BagVisitor& visitor)
{
  const std::size_t count = view.size();
  if (count == 0) {
    throw CloudError("the topic has no messages");
  }
  std::vector<std::uint8_t> bytes;
  sensor_msgs::PointCloud2 message;
  std::size_t index = 0;
  for (const rosbag::MessageInstance& instance : view) {
    std::string reason;
    try {
      readMessage(instance, bytes, message);
    } catch (const std::exception& error) {
      reason = error.what();
    }
    if (reason.empty()) {
      visitor.cloud(message, index, count);
    } else {
      visitor.malformed(reason, index, count);
    }
    ++index;
  }
}

}  // namespace

void readBagClouds(const std::string& path, const std::string& topic, const BagVisitor& visitor)
{
  const auto status = std::filesystem::status(path);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw CloudError(std::filesystem::is_directory(status) ? "is a folder" : "is no regular file");
  }
  checkBag(path);
  try {
    rosbag::Bag bag;  // opened by open(): if the constructor threw, it would leak what it has read
    bag.open(path, rosbag::bagmode::Read);
    rosbag::View view(bag, rosbag::TopicQuery(chooseTopic(bag, topic)));
    visitMessages(view, visitor);
  } catch (const rosbag::BagException& error) {
    throw CloudError(std::string("cannot be read as a bag: ") + error.what());
  } catch (const std::bad_alloc&) {
    throw CloudError("the bag asks for more memory than there is");
  }
}

}  // namespace grasp_affordances
