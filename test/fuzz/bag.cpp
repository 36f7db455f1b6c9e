#include "io/bag.h"
#include "fuzz/check_cloud.h"
#include "fuzz/memory_file.h"

namespace grasp_affordances::fuzz
{

void fuzzBag(const std::uint8_t* data, std::size_t size)
{
  const MemoryFile file(data, size);
  BagVisitor visitor;
  visitor.cloud = [](const sensor_msgs::PointCloud2& message, std::size_t index, std::size_t count) {
    require(index < count, "messages are counted");
    Cloud cloud;
    try {
      cloudFromPointCloud2(message, cloud);
      requireWholeCloud(cloud);
    } catch (const CloudError& error) {
      requireOneLine(error.what());
    }
  };
  visitor.malformed = [](const std::string& reason, std::size_t index, std::size_t count) {
    require(index < count, "malformed messages are counted");
    requireOneLine(reason);
  };
  try {
    readBagClouds(file.path(), "", visitor);
  } catch (const CloudError& error) {
    requireOneLine(error.what());
  }
}

}  // namespace grasp_affordances::fuzz
