#include "io/pcd.h"

#include "io/pcd_header.h"
#include "io/printable.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// Keeps PCL's own messages off stderr.
class SilentPcl
{
public:
  SilentPcl() : level_(pcl::console::getVerbosityLevel()) { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~SilentPcl() { pcl::console::setVerbosityLevel(level_); }
  SilentPcl(const SilentPcl&) = delete;
  SilentPcl& operator=(const SilentPcl&) = delete;

private:
  pcl::console::VERBOSITY_LEVEL level_;
};

/// @param most  points that so many bytes can hold at most
void checkPromise(const PcdHeader& header, std::uint64_t most, std::uint64_t body_size)
{
  if (header.points() > most) {
    throw CloudError("the PCD header promises " + std::to_string(header.points()) + " points of " +
                     std::to_string(header.point_step) + " bytes, more than the " + std::to_string(body_size) +
                     " bytes that follow it can hold");
  }
  if (header.points() > std::numeric_limits<std::uint32_t>::max() / header.point_step) {
    throw CloudError("the PCD file holds more than the 4 GiB that PCL can address");
  }
}

/// A cloud with the header's layout and zeros for data.
pcl::PCLPointCloud2 makeCloud(const PcdHeader& header)
{
  pcl::PCLPointCloud2 cloud;
  cloud.fields = header.fields;
  cloud.width = static_cast<std::uint32_t>(header.width);
  cloud.height = static_cast<std::uint32_t>(header.height);
  cloud.point_step = static_cast<std::uint32_t>(header.point_step);
  cloud.row_step = header.points() == 0 ? 0 : cloud.point_step * cloud.width;
  cloud.is_dense = 0;  // any point may be NaN
  cloud.data.resize(header.points() * header.point_step);
  return cloud;
}

void read(std::istream& file, void* data, std::uint64_t size)
{
  if (!file.read(static_cast<char*>(data), static_cast<std::streamsize>(size))) {
    throw CloudError("the PCD file ended while it was read");
  }
}

bool isBlank(const std::string& line)
{
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

/// PCL reads words that are no numbers, and lines that lack some, as zeros.
/// @return whether lines of nothing but white space are among the points
bool checkAsciiPoints(const PcdHeader& header, std::istream& body)
{
  bool has_blanks = false;
  std::uint64_t points = 0;
  for (std::string line; points < header.points() && std::getline(body, line);) {
    if (isBlank(line)) {
      has_blanks = has_blanks || !line.empty();
      continue;
    }
    ++points;
    std::uint64_t values = 0;
    const char* text = line.c_str();
    for (text += std::strspn(text, " \t\r"); *text != '\0'; text += std::strspn(text, " \t\r"), ++values) {
      char* end = nullptr;
      std::strtod(text, &end);
      const bool hexadecimal =
          std::find_if(text, static_cast<const char*>(end), [](char c) { return c == 'x' || c == 'X'; }) != end;
      if (end == text || std::strchr(" \t\r", *end) == nullptr || hexadecimal) {
        throw CloudError("point " + std::to_string(points) + " of the PCD file holds " +
                         quoted(std::string(text, std::strcspn(text, " \t\r"))) + ", which is no number");
      }
      text = end;
    }
    if (values != header.values_per_point) {
      throw CloudError("point " + std::to_string(points) + " of the PCD file has " + std::to_string(values) +
                       " values, not " + std::to_string(header.values_per_point));
    }
  }
  if (points < header.points()) {
    throw CloudError("the PCD file ends after " + std::to_string(points) + " of " + std::to_string(header.points()) +
                     " points");
  }
  return has_blanks;
}

/// The lines of the points without those between them that hold white space only: PCL skips empty ones, but not these.
std::stringstream linesOfPoints(const PcdHeader& header, std::istream& body)
{
  std::stringstream lines;
  std::uint64_t points = 0;
  for (std::string line; points < header.points() && std::getline(body, line);) {
    if (!isBlank(line)) {
      lines << line << "\n";
      ++points;
    }
  }
  return lines;
}

pcl::PCLPointCloud2 readAscii(const PcdHeader& header, std::istream& file, std::uint64_t body_size)
{
  checkPromise(header, (body_size + 1) / (2 * header.values_per_point), body_size);  // a digit and a separator each
  const bool has_blanks = checkAsciiPoints(header, file);
  file.clear();
  file.seekg(static_cast<std::streamoff>(header.size));
  std::stringstream lines;
  if (has_blanks) {
    lines = linesOfPoints(header, file);
  }
  std::istream& body = has_blanks ? lines : file;
  pcl::PCLPointCloud2 cloud = makeCloud(header);
  if (pcl::PCDReader().readBodyASCII(body, cloud, pcl::PCDReader::PCD_V7) != 0) {
    throw CloudError("PCL cannot read the points of the PCD file");
  }
  return cloud;
}

pcl::PCLPointCloud2 readBinary(const PcdHeader& header, std::istream& file, std::uint64_t body_size)
{
  checkPromise(header, body_size / header.point_step, body_size);
  pcl::PCLPointCloud2 cloud = makeCloud(header);
  read(file, cloud.data.data(), cloud.data.size());
  return cloud;
}

/// The body is one LZF block, field after field, behind its compressed and its uncompressed size.
pcl::PCLPointCloud2 readCompressed(const PcdHeader& header, std::istream& file, std::uint64_t body_size)
{
  constexpr std::uint64_t kLzfMaxRatio = 264 / 3;  // a back reference of 3 bytes stands for at most 264
  for (const auto& field : header.fields) {
    if (field.name == kPcdPadding) {
      throw CloudError("the compressed PCD file has padding fields, which PCL misplaces");
    }
  }
  std::uint32_t sizes[2] = {0, 0};
  if (body_size < sizeof(sizes)) {
    throw CloudError("the PCD file ends before the sizes of its compressed block");
  }
  checkPromise(header, (body_size - sizeof(sizes)) * kLzfMaxRatio / header.point_step, body_size);
  read(file, sizes, sizeof(sizes));
  if (sizes[0] > body_size - sizeof(sizes)) {
    throw CloudError("the compressed block of the PCD file claims " + std::to_string(sizes[0]) + " bytes, " +
                     std::to_string(body_size - sizeof(sizes)) + " follow");
  }
  if (sizes[1] != header.points() * header.point_step) {
    throw CloudError("the compressed block of the PCD file claims to unpack to " + std::to_string(sizes[1]) +
                     " bytes, its header promises " + std::to_string(header.points() * header.point_step));
  }
  std::vector<unsigned char> block(sizeof(sizes) + sizes[0]);
  std::memcpy(block.data(), sizes, sizeof(sizes));
  read(file, block.data() + sizeof(sizes), sizes[0]);
  pcl::PCLPointCloud2 cloud = makeCloud(header);
  if (pcl::PCDReader().readBodyBinary(block.data(), cloud, pcl::PCDReader::PCD_V7, true, 0) != 0) {
    throw CloudError("the compressed block of the PCD file is corrupt");
  }
  return cloud;
}

pcl::PCLPointCloud2 readPoints(const PcdHeader& header, std::istream& file, std::uint64_t body_size)
{
  if (header.points() == 0) {
    return makeCloud(header);
  }
  const SilentPcl silent;
  switch (header.encoding) {
    case PcdEncoding::ascii:
      return readAscii(header, file, body_size);
    case PcdEncoding::binary:
      return readBinary(header, file, body_size);
    case PcdEncoding::compressed:
      break;
  }
  return readCompressed(header, file, body_size);
}

}  // namespace

std::optional<Eigen::Isometry3d> SensorPose::transform() const
{
  constexpr double kMaxDeviation = 1e-3;
  if (!position.allFinite() || !(std::abs(orientation.norm() - 1.0) <= kMaxDeviation)) {
    return std::nullopt;
  }
  return Eigen::Translation3d(position) * orientation.normalized();
}

std::optional<Eigen::Vector3f> SensorPose::sensorOrigin() const
{
  const bool is_turned = transform() && !orientation.vec().isZero(0.0);
  const bool is_default = position.isZero(0.0) && !is_turned;
  return is_default ? std::nullopt : std::make_optional<Eigen::Vector3f>(position.cast<float>());
}

pcl::PCLPointCloud2 readPcd(const std::string& path, SensorPose* viewpoint)
{
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (std::filesystem::is_directory(status)) {
    throw CloudError("is a folder");
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw CloudError("is no regular file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw CloudError(std::generic_category().message(errno));
  }
  const std::uint64_t file_size = std::filesystem::file_size(path);
  if (file_size == 0) {
    throw CloudError("is empty");
  }
  const PcdHeader header = readPcdHeader(file);
  file.clear();
  file.seekg(static_cast<std::streamoff>(header.size));
  pcl::PCLPointCloud2 cloud;
  try {
    cloud = readPoints(header, file, file_size - header.size);
  } catch (const CloudError& error) {
    throw CloudError(error.what() + header.unknown_keys);
  }
  const auto is_padding = [](const pcl::PCLPointField& field) { return field.name == kPcdPadding; };
  cloud.fields.erase(std::remove_if(cloud.fields.begin(), cloud.fields.end(), is_padding), cloud.fields.end());
  if (viewpoint != nullptr) {
    *viewpoint = header.viewpoint;
  }
  return cloud;
}

Cloud readPcdCloud(const std::string& path)
{
  Cloud cloud;
  SensorPose viewpoint;
  cloudFromPointCloud2(readPcd(path, &viewpoint), cloud);
  cloud.sensor_origin = viewpoint.sensorOrigin();
  return cloud;
}

}  // namespace grasp_affordances
