#include "grasp_affordances/point_cloud2.h"
#include "fuzz/bytes.h"
#include "fuzz/check_cloud.h"

#include <sensor_msgs/PointCloud2.h>

#include <algorithm>

namespace grasp_affordances::fuzz
{
namespace
{

constexpr std::size_t kMostBytes = 65536;

/// A number that is small, or whatever the input says.
std::uint32_t number(ByteReader& input, bool lies)
{
  return lies ? input.take<std::uint32_t>() : input.byte();
}

sensor_msgs::PointCloud2 makeMessage(ByteReader& input)
{
  static const char* const kNames[] = {"x", "y", "z", "rgb", "label", "", "xx", "X"};
  sensor_msgs::PointCloud2 message;
  const std::uint32_t lies = input.take<std::uint16_t>();  // a bit for each number that may be any
  message.width = number(input, (lies & 1) != 0);
  message.height = number(input, (lies & 2) != 0);
  message.point_step = number(input, (lies & 4) != 0);
  message.is_bigendian = input.byte();
  message.is_dense = input.byte();
  const std::size_t fields = input.byte() % 9;
  for (std::size_t i = 0; i < fields; ++i) {
    sensor_msgs::PointField field;
    field.name = kNames[input.byte() % 8];
    field.datatype = input.byte();
    field.offset = number(input, (lies & 8) != 0);
    field.count = number(input, (lies & 16) != 0);
    message.fields.push_back(field);
  }
  message.row_step = message.width * message.point_step + input.byte();
  if ((lies & 32) != 0) {
    message.row_step = input.take<std::uint32_t>();
  }
  const std::size_t right = std::size_t{message.height} * message.row_step;
  const std::size_t size = (lies & 64) != 0 || right > kMostBytes ? input.left() : right;
  message.data.assign(size, 0);
  std::copy_n(input.rest(), std::min(size, input.left()), message.data.begin());
  return message;
}

}  // namespace

void fuzzPointCloud2(const std::uint8_t* data, std::size_t size)
{
  ByteReader input(data, size);
  const sensor_msgs::PointCloud2 message = makeMessage(input);
  Cloud cloud;
  cloud.reset(1, 1);
  try {
    cloudFromPointCloud2(message, cloud);
    const bool empty = message.width == 0 || message.height == 0;
    require(cloud.width == (empty ? 0 : message.width) && cloud.height == (empty ? 0 : message.height),
            "the cloud has the size of the message");
  } catch (const CloudError& error) {
    requireOneLine(error.what());
    require(cloud.size() == 1, "a refused message leaves the cloud as it was");
  }
  requireWholeCloud(cloud);
}

}  // namespace grasp_affordances::fuzz
