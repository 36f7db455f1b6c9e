#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace grasp_affordances::fuzz
{

/// A file that lies in memory only, and that can be opened by its path.
class MemoryFile
{
public:
  MemoryFile(const std::uint8_t* data, std::size_t size);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
  int descriptor_;
};

}  // namespace grasp_affordances::fuzz
