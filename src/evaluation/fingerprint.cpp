#include "evaluation/fingerprint.h"

#include <link.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

/// FNV-1a (Fowler, Noll and Vo), 64 bits.
class Fnv
{
public:
  void add(const char* bytes, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i) {
      hash_ = (hash_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001B3U;
    }
  }

  std::string digits() const
  {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash_));
    return text.data();
  }

private:
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace

std::string fingerprintOfText(const std::string& text)
{
  Fnv hash;
  hash.add(text.data(), text.size());
  return hash.digits();
}

std::string fingerprintOfFiles(const std::vector<std::string>& paths)
{
  Fnv hash;
  for (const std::string& path : paths) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
      throw std::runtime_error(path + ": cannot be read");
    }
    std::vector<char> bytes(std::size_t{1} << 20U);
    while (file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || file.gcount() > 0) {
      hash.add(bytes.data(), static_cast<std::size_t>(file.gcount()));
    }
  }
  return hash.digits();
}

std::string fingerprintOfCode()
{
  std::vector<std::string> files;
  const auto addOurs = [](dl_phdr_info* library, std::size_t, void* list) {
    const std::string path = library->dlpi_name;
    if (path.find("/libgrasp_affordances") != std::string::npos) {
      static_cast<std::vector<std::string>*>(list)->push_back(path);
    }
    return 0;
  };
  dl_iterate_phdr(addOurs, &files);
  std::sort(files.begin(), files.end());
  files.emplace_back("/proc/self/exe");
  return fingerprintOfFiles(files);
}

}  // namespace grasp_affordances
