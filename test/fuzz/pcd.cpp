#include "io/pcd.h"
#include "fuzz/check_cloud.h"
#include "fuzz/memory_file.h"

namespace grasp_affordances::fuzz
{

void fuzzPcd(const std::uint8_t* data, std::size_t size)
{
  const MemoryFile file(data, size);
  try {
    requireWholeCloud(readPcdCloud(file.path()));
  } catch (const CloudError& error) {
    requireOneLine(error.what());
  }
}

}  // namespace grasp_affordances::fuzz
