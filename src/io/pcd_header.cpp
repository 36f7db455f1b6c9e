#include "io/pcd_header.h"

#include "grasp_affordances/point_cloud2.h"
#include "io/content_kind.h"
#include "io/printable.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr std::int64_t kMaxHeaderSize = 65536;  // bytes; PCL writes a few hundred
constexpr std::size_t kMostUnknown = 3;         // keys that an error names

using Words = std::vector<std::string>;

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
    throw CloudError("PCD header: " + key + " " + quoted(word) + " is no integer from " + std::to_string(min) + " to " +
                     std::to_string(kMax));
  }
  return value;
}

/// The header's entries by key, up to and with DATA.
class Entries
{
public:
  Entries(std::istream& file, std::size_t& size)
  {
    std::string text(kMaxHeaderSize, '\0');
    file.read(&text[0], static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text.rfind(kBagMagic, 0) == 0) {
      throw CloudError(noPcdFile(text));
    }
    std::size_t begin = 0;
    while (words_.count("DATA") == 0) {
      const std::size_t end = text.find('\n', begin);
      if (end == std::string::npos && !words_.empty()) {
        throw CloudError("the PCD header ends without a DATA line" + unknownKeys());
      }
      if (end == std::string::npos) {
        throw CloudError(noPcdFile(text));
      }
      add(split(text.substr(begin, end - begin)));
      begin = end + 1;
    }
    if (words_.size() == 1) {  // a line of another text begins with DATA
      throw CloudError(noPcdFile(text));
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

  /// What an error adds: a misspelled key may be the reason. Empty where all keys are known.
  std::string unknownKeys() const
  {
    std::string keys;
    for (const std::string& key : unknown_) {
      keys += (keys.empty() ? "" : ", ") + quoted(key);
    }
    return keys.empty() ? "" : "; unknown keys in the header: " + keys;
  }

private:
  static std::string noPcdFile(const std::string& begin)
  {
    const std::string kind = contentKind(begin);
    return kind == contentKind(kBagMagic) ? "no PCD file, but " + kind : "no PCD file and no bag, but " + kind;
  }

  void add(Words words)
  {
    if (words.empty() || words.front().front() == '#') {
      return;
    }
    std::string key = words.front() == "COLUMNS" ? "FIELDS" : words.front();
    static const Words kKeys{"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                             "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      if (unknown_.size() < kMostUnknown) {
        unknown_.push_back(key);
      }
      return;
    }
    words.erase(words.begin());
    if (!words_.emplace(key, std::move(words)).second) {
      throw CloudError("PCD header: two lines " + key + unknownKeys());
    }
  }

  std::map<std::string, Words> words_;
  Words unknown_;  // the first keys of that kind
};

/// Values of SIZE, TYPE or COUNT: one per field. Files of old versions leave the line out.
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

void parseFields(const Entries& entries, PcdHeader& header)
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
    // PCL writes padding that steps backwards before a field whose offset is less than that of the one before it.
    const bool may_step_back = names[i] == kPcdPadding && header.encoding == PcdEncoding::binary;
    const std::int64_t count = parseInteger("COUNT", counts[i], may_step_back ? -kMaxHeaderSize : 1);
    const std::int64_t size = parseInteger("SIZE", sizes[i]);
    const int datatype = size > 8 || types[i].size() != 1 ? -1 : pcl::getFieldType(static_cast<int>(size), types[i][0]);
    if (datatype < 0) {
      throw CloudError("PCD header: field " + printable(names[i]) + " has SIZE " + printable(sizes[i]) + " and TYPE " +
                       printable(types[i]) + ", which is not a type of PCL");
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
      throw CloudError("PCD header: COUNT " + printable(counts[i]) + " steps back over the start of the point");
    }
  }
  header.point_step = static_cast<std::uint64_t>(offset);
  for (const auto& field : header.fields) {
    const std::uint64_t size = std::uint64_t(pcl::getFieldSize(field.datatype)) * field.count;
    if (field.name != kPcdPadding && field.offset + size > header.point_step) {
      throw CloudError("PCD header: field " + printable(field.name) + " lies outside the point's " +
                       std::to_string(header.point_step) + " bytes");
    }
  }
}

void parseExtent(const Entries& entries, PcdHeader& header)
{
  const std::uint64_t points = entries.count("POINTS");
  header.width = entries.has("WIDTH") ? entries.count("WIDTH") : points;
  header.height = entries.has("HEIGHT") ? entries.count("HEIGHT") : 1;
  if (header.points() != points) {
    throw CloudError("PCD header: WIDTH " + std::to_string(header.width) + " times HEIGHT " +
                     std::to_string(header.height) + " is not POINTS " + std::to_string(points));
  }
}

double parseDouble(const std::string& word)
{
  std::istringstream stream(word);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !stream.eof()) {
    throw CloudError("PCD header: VIEWPOINT needs finite numbers, " + quoted(word) + " is none");
  }
  return value;
}

SensorPose parseViewpoint(const Words& words)
{
  std::array<double, 7> values{};
  if (words.size() != values.size()) {
    throw CloudError("PCD header: VIEWPOINT needs seven numbers (tx ty tz qw qx qy qz), it has " +
                     std::to_string(words.size()));
  }
  std::transform(words.begin(), words.end(), values.begin(), parseDouble);
  return {{values[0], values[1], values[2]}, Eigen::Quaterniond(values[3], values[4], values[5], values[6])};
}

PcdEncoding parseEncoding(const Words& words)
{
  static const std::map<std::string, PcdEncoding> kEncodings{
      {"ascii", PcdEncoding::ascii}, {"binary", PcdEncoding::binary}, {"binary_compressed", PcdEncoding::compressed}};
  const auto encoding = words.size() == 1 ? kEncodings.find(words.front()) : kEncodings.end();
  if (encoding == kEncodings.end()) {
    const std::string data = words.empty() ? "" : " " + quoted(words.front());
    throw CloudError("PCD header: DATA" + data + " is not one of ascii, binary, binary_compressed");
  }
  return encoding->second;
}

}  // namespace

PcdHeader readPcdHeader(std::istream& file)
{
  PcdHeader header;
  const Entries entries(file, header.size);
  header.unknown_keys = entries.unknownKeys();
  try {
    header.encoding = parseEncoding(entries.words("DATA"));
    parseFields(entries, header);
    parseExtent(entries, header);
    if (entries.has("VIEWPOINT")) {
      header.viewpoint = parseViewpoint(entries.words("VIEWPOINT"));
    }
  } catch (const CloudError& error) {
    throw CloudError(error.what() + header.unknown_keys);
  }
  return header;
}

}  // namespace grasp_affordances
