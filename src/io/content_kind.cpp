#include "io/content_kind.h"

#include <algorithm>
#include <cstddef>

namespace grasp_affordances
{
namespace
{

struct Kind
{
  const char* magic;
  const char* name;
};

constexpr Kind kKinds[] = {
    {kBagMagic, "a bag"},
    {"ply\n", "a PLY file"},
    {"ply\r", "a PLY file"},
    {"LASF", "a LAS file"},
    {"solid ", "an STL file"},
    {"OFF\n", "an OFF file"},
    {"\x93NUMPY", "an array of NumPy"},
    {"\x89HDF", "an HDF5 file"},
    {"\x89MCAP", "an MCAP file"},
    {"SQLite format 3", "a database of SQLite, as in bags of ROS 2"},
    {"\x89PNG", "a PNG image"},
    {"\xFF\xD8\xFF", "a JPEG image"},
    {"\x1F\x8B", "compressed by gzip"},
    {"BZh", "compressed by bzip2"},
    {"\xFD\x37zXZ", "compressed by xz"},
    {"\x28\xB5\x2F\xFD", "compressed by Zstandard"},
    {"\x04\x22\x4D\x18", "compressed by LZ4"},
    {"PK\x03\x04", "a ZIP archive"},
    {"\x7F\x45LF", "a program"},
    {"version https://git-lfs", "a pointer of Git LFS (git lfs pull gets the file)"},
    {"<!DOCTYPE", "a web page"},
    {"<!doctype", "a web page"},
    {"<html", "a web page"},
};

bool isText(const std::string& begin)
{
  return std::all_of(begin.begin(), begin.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 ? byte != 0x7F : byte == '\t' || byte == '\n' || byte == '\r' || byte == '\f';
  });
}

}  // namespace

std::string contentKind(const std::string& begin)
{
  for (const Kind& kind : kKinds) {
    if (begin.rfind(kind.magic, 0) == 0) {
      return kind.name;
    }
  }
  constexpr std::size_t kLooked = 1000;
  return isText(begin.substr(0, kLooked)) ? "text" : "binary data";
}

}  // namespace grasp_affordances
