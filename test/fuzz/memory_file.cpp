#include "fuzz/memory_file.h"

#include "fuzz/targets.h"

#include <sys/mman.h>
#include <unistd.h>

namespace grasp_affordances::fuzz
{

MemoryFile::MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC))
{
  require(descriptor_ >= 0, "a file in memory can be made");
  require(::write(descriptor_, data, size) == static_cast<ssize_t>(size), "and be written");
}

MemoryFile::~MemoryFile()
{
  ::close(descriptor_);
}

}  // namespace grasp_affordances::fuzz
