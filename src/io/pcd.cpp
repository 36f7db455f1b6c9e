#include "io/pcd.h"

#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <system_error>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr std::int64_t kMaxHeaderSize = 65536;  // bytes; PCL writes a few hundred
const char* const kPadding = "_";               // name of padding fields

using Words = std::vector<std::string>;

enum class Encoding
{
  ascii,
  binary,
  compressed
};

struct Header
{
  std::vector<pcl::PCLPointField> fields;
  std::uint64_t point_step = 0;        // bytes
  std::uint64_t values_per_point = 0;  // numbers per line of an ascii file
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  SensorPose viewpoint;
  Encoding encoding = Encoding::ascii;
  std::size_t size = 0;  // bytes of the header text
  std::uint64_t points() const { return width * height; }
};

/// Suppresses PCL's own messages on stderr.
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

Words split(const std::string& line)
{
  std::istringstream stream(line);
  Words words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

std::int64_t parseInteger(const std::string& key, const std::string& word, std::int64_t min = 0)
{
  constexpr std::int64_t kMax = std::numeric_limits<std::uint32_t>::max();
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || value < min || value > kMax) {
    throw CloudError("PCD header: " + key + " '" + word + "' is no integer from " + std::to_string(min) + " to " +
                     std::to_string(kMax));
  }
  return value;
}

/// The entries of the header by key, up to and including DATA.
class Entries
{
public:
  Entries(std::istream& file, std::size_t& size)
  {
    std::string text(kMaxHeaderSize, '\0');
    file.read(&text[0], static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    std::size_t begin = 0;
    while (words_.count("DATA") == 0) {
      const std::size_t end = text.find('\n', begin);
      if (end == std::string::npos) {
        throw CloudError(words_.empty() ? "no PCD file" : "the PCD header ends without a DATA line");
      }
      add(split(text.substr(begin, end - begin)));
      begin = end + 1;
    }
    size = begin;
  }

  bool has(const std::string& key) const { return words_.count(key) != 0; }

  const Words& words(const std::string& key) const
  {
    const auto entry = words_.find(key);
    if (entry == words_.end()) {
      throw CloudError("the PCD header has no " + key + " line");
    }
    return entry->second;
  }

  std::uint64_t count(const std::string& key) const
  {
    const Words& values = words(key);
    if (values.size() != 1) {
      throw CloudError("PCD header: " + key + " needs one value, it has " + std::to_string(values.size()));
    }
    return static_cast<std::uint64_t>(parseInteger(key, values.front()));
  }

private:
  void add(Words words)
  {
    if (words.empty() || words.front().front() == '#') {
      return;
    }
    std::string key = words.front() == "COLUMNS" ? "FIELDS" : words.front();
    static const Words kKeys{"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                             "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      throw CloudError(words_.empty() ? "no PCD file" : "PCD header: a line follows " + last_ + " that has no PCD key");
    }
    last_ = key;
    words.erase(words.begin());
    if (!words_.emplace(key, std::move(words)).second) {
      throw CloudError("PCD header: two lines " + key);
    }
  }

  std::map<std::string, Words> words_;
  std::string last_;
};

/// Values of SIZE, TYPE or COUNT, one per field. Files of old versions do not have the line.
Words perField(const Entries& entries, const std::string& key, std::size_t fields, const char* default_value)
{
  if (!entries.has(key)) {
    return Words(fields, default_value);
  }
  const Words& words = entries.words(key);
  if (words.size() != fields) {
    throw CloudError("PCD header: " + key + " has " + std::to_string(words.size()) + " values for " +
                     std::to_string(fields) + " fields");
  }
  return words;
}

void parseFields(const Entries& entries, Header& header)
{
  const Words& names = entries.words("FIELDS");
  if (names.empty()) {
    throw CloudError("PCD header: FIELDS names no field");
  }
  if (entries.has("SIZE") != entries.has("TYPE")) {
    throw CloudError("PCD header: SIZE and TYPE must both be given or both be left out");
  }
  const Words sizes = perField(entries, "SIZE", names.size(), "4");
  const Words types = perField(entries, "TYPE", names.size(), "F");
  const Words counts = perField(entries, "COUNT", names.size(), "1");
  std::int64_t offset = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    // If a field's offset is less than that of the field before it, PCL writes padding of negative size between them.
    const bool may_step_back = names[i] == kPadding && header.encoding == Encoding::binary;
    const std::int64_t count = parseInteger("COUNT", counts[i], may_step_back ? -kMaxHeaderSize : 1);
    const std::int64_t size = parseInteger("SIZE", sizes[i]);
    const int datatype = size > 8 || types[i].size() != 1 ? -1 : pcl::getFieldType(static_cast<int>(size), types[i][0]);
    if (datatype < 0) {
      throw CloudError("PCD header: field " + names[i] + " has SIZE " + sizes[i] + " and TYPE " + types[i] +
                       ", which is not a type of PCL");
    }
    pcl::PCLPointField field;
    field.name = names[i];
    field.offset = static_cast<std::uint32_t>(offset);
    field.datatype = static_cast<std::uint8_t>(datatype);
    field.count = static_cast<std::uint32_t>(count);
    header.fields.push_back(field);
    header.values_per_point += static_cast<std::uint64_t>(count);
    offset += size * count;
    if (offset < 1) {
      throw CloudError("PCD header: COUNT " + counts[i] + " steps back over the start of the point");
    }
  }
  header.point_step = static_cast<std::uint64_t>(offset);
  for (const auto& field : header.fields) {
    const std::uint64_t size = std::uint64_t(pcl::getFieldSize(field.datatype)) * field.count;
    if (field.name != kPadding && field.offset + size > header.point_step) {
      throw CloudError("PCD header: field " + field.name + " lies outside the point's " +
                       std::to_string(header.point_step) + " bytes");
    }
  }
}

void parseExtent(const Entries& entries, Header& header)
{
  const std::uint64_t points = entries.count("POINTS");
  header.width = entries.has("WIDTH") ? entries.count("WIDTH") : points;
  header.height = entries.has("HEIGHT") ? entries.count("HEIGHT") : 1;
  if (header.points() != points) {
    throw CloudError("PCD header: WIDTH " + std::to_string(header.width) + " times HEIGHT " +
                     std::to_string(header.height) + " is not POINTS " + std::to_string(points));
  }
}

SensorPose parseViewpoint(const Words& words)
{
  std::array<double, 7> values{};
  bool valid = words.size() == values.size();
  for (std::size_t i = 0; valid && i < values.size(); ++i) {
    std::istringstream stream(words[i]);
    stream.imbue(std::locale::classic());
    valid = (stream >> values[i]) && stream.eof();
  }
  if (!valid) {
    throw CloudError("PCD header: VIEWPOINT needs seven finite numbers (tx ty tz qw qx qy qz)");
  }
  return {{values[0], values[1], values[2]}, Eigen::Quaterniond(values[3], values[4], values[5], values[6])};
}

Encoding parseEncoding(const Words& words)
{
  static const std::map<std::string, Encoding> kEncodings{
      {"ascii", Encoding::ascii}, {"binary", Encoding::binary}, {"binary_compressed", Encoding::compressed}};
  const auto encoding = words.size() == 1 ? kEncodings.find(words.front()) : kEncodings.end();
  if (encoding == kEncodings.end()) {
    throw CloudError("PCD header: DATA is not one of ascii, binary, binary_compressed");
  }
  return encoding->second;
}

Header readHeader(std::istream& file)
{
  Header header;
  const Entries entries(file, header.size);
  header.encoding = parseEncoding(entries.words("DATA"));
  parseFields(entries, header);
  parseExtent(entries, header);
  if (entries.has("VIEWPOINT")) {
    header.viewpoint = parseViewpoint(entries.words("VIEWPOINT"));
  }
  return header;
}

/// @param most  largest number of points that so many bytes can contain
void checkPromise(const Header& header, std::uint64_t most, std::uint64_t body_size)
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

/// A cloud with the header's layout; its data is zero.
pcl::PCLPointCloud2 makeCloud(const Header& header)
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

/// Checks the numbers of an ascii file, because PCL reads words that are not numbers, and missing values, as zeros.
void checkAsciiPoints(const Header& header, std::istream& body)
{
  std::uint64_t points = 0;
  for (std::string line; points < header.points() && std::getline(body, line);) {
    if (line.empty()) {
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
        throw CloudError("point " + std::to_string(points) + " of the PCD file holds something that is no number");
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
}

pcl::PCLPointCloud2 readAscii(const Header& header, std::istream& file, std::uint64_t body_size)
{
  checkPromise(header, (body_size + 1) / (2 * header.values_per_point), body_size);  // a digit and a separator each
  checkAsciiPoints(header, file);
  file.clear();
  file.seekg(static_cast<std::streamoff>(header.size));
  pcl::PCLPointCloud2 cloud = makeCloud(header);
  if (pcl::PCDReader().readBodyASCII(file, cloud, pcl::PCDReader::PCD_V7) != 0) {
    throw CloudError("PCL cannot read the points of the PCD file");
  }
  return cloud;
}

pcl::PCLPointCloud2 readBinary(const Header& header, std::istream& file, std::uint64_t body_size)
{
  checkPromise(header, body_size / header.point_step, body_size);
  pcl::PCLPointCloud2 cloud = makeCloud(header);
  read(file, cloud.data.data(), cloud.data.size());
  return cloud;
}

/// Reads a compressed body: the compressed size, the uncompressed size, and one LZF block with the fields one after
/// another.
pcl::PCLPointCloud2 readCompressed(const Header& header, std::istream& file, std::uint64_t body_size)
{
  constexpr std::uint64_t kLzfMaxRatio = 264 / 3;  // a back reference of 3 bytes stands for at most 264 bytes
  for (const auto& field : header.fields) {
    if (field.name == kPadding) {
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

pcl::PCLPointCloud2 readPoints(const Header& header, std::istream& file, std::uint64_t body_size)
{
  if (header.points() == 0) {
    return makeCloud(header);
  }
  const SilentPcl silent;
  switch (header.encoding) {
    case Encoding::ascii:
      return readAscii(header, file, body_size);
    case Encoding::binary:
      return readBinary(header, file, body_size);
    case Encoding::compressed:
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

pcl::PCLPointCloud2 readPcd(const std::string& path, SensorPose* viewpoint)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
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
  const Header header = readHeader(file);
  file.clear();
  file.seekg(static_cast<std::streamoff>(header.size));
  pcl::PCLPointCloud2 cloud = readPoints(header, file, file_size - header.size);
  const auto is_padding = [](const pcl::PCLPointField& field) { return field.name == kPadding; };
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
  cloud.sensor_origin = viewpoint.position.cast<float>();
  return cloud;
}

}  // namespace grasp_affordances
