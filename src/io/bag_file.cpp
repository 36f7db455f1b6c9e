#include "io/bag_file.h"

#include "grasp_affordances/point_cloud2.h"
#include "io/content_kind.h"

#include <bzlib.h>
#include <rosbag/constants.h>
#include <roslz4/lz4s.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr std::uint32_t kMostFieldBytes = 1000000;   // roscpp rejects longer fields
constexpr std::uint32_t kMostChunkBytes = 1U << 30;  // after decompression
constexpr std::uint32_t kNanosecondsPerSecond = 1000000000;
constexpr std::size_t kNoChunk = std::numeric_limits<std::size_t>::max();

void require(bool holds, const std::string& reason)
{
  if (!holds) {
    throw CloudError("the bag is damaged: " + reason);
  }
}

std::string readBytes(const BagRegion& region, std::uint64_t at, std::uint64_t length, const char* of)
{
  require(at <= region.size && length <= region.size - at, std::string(of) + " reaches beyond its end");
  std::string bytes(length, '\0');
  region.copy(at, bytes.data(), length);
  return bytes;
}

template <typename T>
T numberAt(const std::string& bytes, std::size_t at)
{
  T value;
  std::memcpy(&value, &bytes[at], sizeof(value));
  return value;
}

std::uint32_t readNumber(const BagRegion& region, std::uint64_t at, const char* of)
{
  return numberAt<std::uint32_t>(readBytes(region, at, sizeof(std::uint32_t), of), 0);
}

/// The fields NAME=VALUE of a header. Each is preceded by its length.
class Fields
{
public:
  explicit Fields(const std::string& header)
  {
    for (std::size_t at = 0; at < header.size();) {
      require(header.size() - at >= 4, "a header ends within a field");
      const auto length = numberAt<std::uint32_t>(header, at);
      at += 4;
      require(length <= kMostFieldBytes && length <= header.size() - at, "a field reaches beyond its header");
      const std::size_t separator = header.find('=', at);
      require(separator < at + length, "a field has no name");
      require(
          values_.emplace(header.substr(at, separator - at), header.substr(separator + 1, at + length - separator - 1))
              .second,
          "a header has a field twice");
      at += length;
    }
  }

  bool has(const std::string& name) const { return values_.count(name) != 0; }

  const std::string& text(const std::string& name) const
  {
    const auto found = values_.find(name);
    require(found != values_.end(), "a header has no field " + name);
    return found->second;
  }

  template <typename T>
  T number(const std::string& name) const
  {
    const std::string& value = text(name);
    require(value.size() == sizeof(T), "the field " + name + " has the wrong size");
    return numberAt<T>(value, 0);
  }

private:
  std::map<std::string, std::string> values_;
};

/// A record: a header, then data. Each is preceded by its length.
struct Record
{
  Fields header;
  std::uint64_t data;  // its start in the region
  std::uint32_t size;  // size of the data

  std::uint64_t end() const { return data + size; }
};

Record readRecord(const BagRegion& region, std::uint64_t at, std::uint8_t op, const char* of)
{
  const std::uint32_t header_size = readNumber(region, at, of);
  Fields header(readBytes(region, at + 4, header_size, of));
  const std::uint64_t data = at + 4 + header_size + 4;
  Record record{std::move(header), data, readNumber(region, data - 4, of)};
  require(record.header.number<std::uint8_t>(rosbag::OP_FIELD_NAME) == op, std::string("there is no ") + of);
  require(record.end() <= region.size, std::string(of) + " reaches beyond its end");
  return record;
}

/// A name may have blanks in it and be of any language.
void requireName(const std::string& name, const char* of)
{
  const auto is_control = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
  require(std::none_of(name.begin(), name.end(), is_control),
          std::string("the ") + of + " of a connection is not a valid name");
}

/// Checks the blocks of an LZ4 frame. roslz4 does not: it copies a block into a buffer of the size that the frame's
/// header states, even if the block is larger.
/// @return upper bound of the frame's uncompressed size, bytes
std::uint64_t requireSoundLz4(const std::string& frame)
{
  constexpr std::size_t kHeader = 7, kEnd = 8;  // magic number, flags, sizes, check; an empty block, checksum
  constexpr std::uint64_t kMostPerByte = 255;   // a further byte of a match's length stands for so many bytes
  require(frame.size() >= kHeader + kEnd, "a chunk ends within its LZ4 frame");
  const int size_id = static_cast<unsigned char>(frame[5]) >> 4 & 7;
  const int most = size_id < 4 ? -1 : roslz4_blockSizeFromIndex(size_id);
  require(most > 0, "an LZ4 frame has no block size");
  std::uint64_t unpacked = 0;
  for (std::size_t at = kHeader;;) {
    require(frame.size() - at >= kEnd, "an LZ4 frame has no end");
    const std::uint32_t size = numberAt<std::uint32_t>(frame, at) & 0x7fffffffU;
    at += 4;
    if (size == 0) {
      require(frame.size() - at == 4, "something follows an LZ4 frame");
      return unpacked;
    }
    require(size <= static_cast<std::uint32_t>(most) && size <= frame.size() - at, "an LZ4 block is too large");
    unpacked += std::min<std::uint64_t>(static_cast<std::uint32_t>(most), kMostPerByte * size);
    at += size;
  }
}

void requireUnpacked(bool holds)
{
  require(holds, "a chunk does not unpack to what it claims");
}

std::string unpackLz4(std::string& packed, std::uint32_t size)
{
  requireUnpacked(size <= requireSoundLz4(packed));
  std::string bytes(size, '\0');
  unsigned int unpacked = size;
  requireUnpacked(roslz4_buffToBuffDecompress(packed.data(), static_cast<unsigned int>(packed.size()), bytes.data(),
                                              &unpacked) == ROSLZ4_OK);
  requireUnpacked(unpacked == size);
  return bytes;
}

/// Decompresses a chunk. Memory grows with the decompressed data; the size that the chunk states is not trusted.
std::string unpackBz2(std::string& packed, std::uint32_t size)
{
  constexpr std::size_t kStep = 1U << 20;
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) {
    throw CloudError("there is no memory to unpack a chunk of the bag");
  }
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream, BZ2_bzDecompressEnd);
  stream.next_in = packed.data();
  stream.avail_in = static_cast<unsigned int>(packed.size());
  std::string bytes;
  int status = BZ_OK;
  while (status == BZ_OK && stream.avail_out == 0 && bytes.size() < size) {
    const std::size_t filled = bytes.size();
    bytes.resize(std::min<std::size_t>(size, filled + std::max(filled, kStep)));
    stream.next_out = &bytes[filled];
    stream.avail_out = static_cast<unsigned int>(bytes.size() - filled);
    status = BZ2_bzDecompress(&stream);
  }
  requireUnpacked(status == BZ_STREAM_END && stream.avail_out == 0 && bytes.size() == size);
  return bytes;
}

/// The content of a chunk. For an uncompressed chunk it refers to the file.
BagRegion unpack(const BagRegion& file, const Record& chunk)
{
  const std::string& compression = chunk.header.text(rosbag::COMPRESSION_FIELD_NAME);
  const auto size = chunk.header.number<std::uint32_t>(rosbag::SIZE_FIELD_NAME);
  if (compression == rosbag::COMPRESSION_NONE) {
    require(size == chunk.size, "a chunk is not as long as it claims");
    return {size, [&file, begin = chunk.data](std::uint64_t at, void* to, std::size_t length) {
              file.copy(begin + at, to, length);
            }};
  }
  require(compression == rosbag::COMPRESSION_LZ4 || compression == rosbag::COMPRESSION_BZ2,
          "a chunk has an unknown compression");
  require(size <= kMostChunkBytes && chunk.size <= kMostChunkBytes, "a compressed chunk claims more than 1 GiB");
  std::string packed = readBytes(file, chunk.data, chunk.size, "a chunk");
  const auto bytes = std::make_shared<const std::string>(
      compression == rosbag::COMPRESSION_LZ4 ? unpackLz4(packed, size) : unpackBz2(packed, size));
  return {size,
          [bytes](std::uint64_t at, void* to, std::size_t length) { std::memcpy(to, bytes->data() + at, length); }};
}

/// Each message lies within the chunk, behind the one before.
void requireMessages(const BagRegion& chunk, const std::vector<std::uint32_t>& places)
{
  std::uint64_t end = 0;
  for (const std::uint32_t place : places) {
    require(place >= end, "messages overlap");
    end = readRecord(chunk, place, rosbag::OP_MSG_DATA, "a message").end();
  }
}

}  // namespace

BagFile::BagFile(const std::string& path, std::string type) : type_(std::move(type)), opened_(kNoChunk)
{
  errno = 0;
  stream_.open(path, std::ios::binary | std::ios::ate);
  if (!stream_) {
    throw CloudError(std::string("cannot be read as a bag: ") + std::generic_category().message(errno));
  }
  file_ = {static_cast<std::uint64_t>(stream_.tellg()), [this](std::uint64_t at, void* to, std::size_t size) {
             stream_.seekg(static_cast<std::streamoff>(at));
             require(!!stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(size)), "it cannot be read");
           }};
  readIndex();
}

void BagFile::readIndex()
{
  const std::string kVersion = "#ROSBAG V2.0\n", kOldVersion = std::string(kBagMagic) + "1.";
  const std::string version = readBytes(file_, 0, std::min<std::uint64_t>(kVersion.size(), file_.size), "the bag");
  if (version.compare(0, kOldVersion.size(), kOldVersion) == 0) {
    throw CloudError("the bag is older than version 2.0 (rosbag fix may help)");
  }
  if (version != kVersion) {
    throw CloudError("cannot be read as a bag: it does not begin with " + kVersion.substr(0, kVersion.size() - 1));
  }
  const Record header = readRecord(file_, kVersion.size(), rosbag::OP_FILE_HEADER, "the header of the bag");
  if (header.header.has(rosbag::ENCRYPTOR_FIELD_NAME)) {
    throw CloudError("the bag is encrypted (rosbag decrypt may help)");
  }
  position_ = header.header.number<std::uint64_t>(rosbag::INDEX_POS_FIELD_NAME);
  if (position_ == 0) {
    throw CloudError("the bag was not closed, so that it has no index (rosbag reindex makes one)");
  }
  readConnections(header.header.number<std::uint32_t>(rosbag::CONNECTION_COUNT_FIELD_NAME));
  readChunks(header.header.number<std::uint32_t>(rosbag::CHUNK_COUNT_FIELD_NAME));
}

void BagFile::readConnections(std::uint32_t count)
{
  const auto text = [](const Fields& fields, const char* name) { return fields.has(name) ? fields.text(name) : ""; };
  for (; count > 0; --count) {
    const Record record = readRecord(file_, position_, rosbag::OP_CONNECTION, "a connection");
    const Fields fields(readBytes(file_, record.data, record.size, "a connection"));
    BagConnection connection;
    connection.topic = record.header.text(rosbag::TOPIC_FIELD_NAME);
    connection.type = text(fields, "type");
    connection.md5sum = text(fields, "md5sum");
    requireName(connection.topic, "topic");
    requireName(connection.type, "type");
    // If several connections have one number, the first counts.
    connections_.emplace(record.header.number<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME), std::move(connection));
    position_ = record.end();
  }
}

void BagFile::readChunks(std::uint32_t count)
{
  std::vector<std::pair<std::uint64_t, std::uint64_t>> extents;  // start and end of each chunk with its indexes
  for (; count > 0; --count) {
    const Record record = readRecord(file_, position_, rosbag::OP_CHUNK_INFO, "the information on a chunk");
    require(record.header.number<std::uint32_t>(rosbag::VER_FIELD_NAME) == rosbag::CHUNK_INFO_VERSION,
            "the information on a chunk is of another version");
    record.header.number<std::uint64_t>(rosbag::START_TIME_FIELD_NAME);
    record.header.number<std::uint64_t>(rosbag::END_TIME_FIELD_NAME);
    const auto indexes = record.header.number<std::uint32_t>(rosbag::COUNT_FIELD_NAME);
    require(record.size == std::uint64_t{8} * indexes, "the information on a chunk is not as long as it claims");
    const std::string data = readBytes(file_, record.data, record.size, "the information on a chunk");
    std::set<std::uint32_t> connections;
    for (std::size_t at = 0; at < data.size(); at += 8) {
      connections.insert(numberAt<std::uint32_t>(data, at));
    }
    const auto begin = record.header.number<std::uint64_t>(rosbag::CHUNK_POS_FIELD_NAME);
    extents.emplace_back(begin, readChunk(begin, connections.size()));
    position_ = record.end();
  }
  std::sort(extents.begin(), extents.end());
  for (std::size_t i = 1; i < extents.size(); ++i) {
    require(extents[i - 1].second <= extents[i].first, "chunks overlap");
  }
}

/// @return the end of the indexes that follow the chunk
std::uint64_t BagFile::readChunk(std::uint64_t begin, std::size_t indexes)
{
  const Record record = readRecord(file_, begin, rosbag::OP_CHUNK, "a chunk");
  require(!record.header.text(rosbag::COMPRESSION_FIELD_NAME).empty(), "a chunk names no compression");
  record.header.number<std::uint32_t>(rosbag::SIZE_FIELD_NAME);
  Chunk chunk{begin, {}};
  std::uint64_t position = record.end();
  for (; indexes > 0; --indexes) {
    position = readChunkIndex(position, chunk);
  }
  if (!chunk.places.empty()) {
    std::sort(chunk.places.begin(), chunk.places.end());
    chunks_.push_back(std::move(chunk));
  }
  return position;
}

/// Reads where a chunk has the messages of one connection.
/// @return the end of that index
std::uint64_t BagFile::readChunkIndex(std::uint64_t position, Chunk& chunk)
{
  const Record record = readRecord(file_, position, rosbag::OP_INDEX_DATA, "the index of a chunk");
  require(record.header.number<std::uint32_t>(rosbag::VER_FIELD_NAME) == rosbag::INDEX_VERSION,
          "an index is of another version");
  const auto connection = connections_.find(record.header.number<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME));
  require(connection != connections_.end(), "an index belongs to no connection");
  const auto count = record.header.number<std::uint32_t>(rosbag::COUNT_FIELD_NAME);
  constexpr std::size_t kEntry = 12;  // bytes: seconds, nanoseconds, place in the chunk
  require(record.size == std::uint64_t{kEntry} * count, "an index is not as long as it claims");
  connection->second.messages += count;
  const bool is_wanted = connection->second.type == type_;
  const std::string data = readBytes(file_, record.data, record.size, "an index");
  for (std::size_t at = 0; at < data.size(); at += kEntry) {
    const auto nanoseconds = numberAt<std::uint32_t>(data, at + 4);
    require(nanoseconds < kNanosecondsPerSecond, "a message has no time");
    if (is_wanted) {
      const std::uint64_t seconds = numberAt<std::uint32_t>(data, at);
      chunk.places.push_back(numberAt<std::uint32_t>(data, at + 8));
      entries_.push_back(
          {seconds * kNanosecondsPerSecond + nanoseconds, connection->first, chunk.places.back(), chunks_.size()});
    }
  }
  return record.end();
}

void BagFile::open(std::size_t chunk)
{
  if (opened_ == chunk) {
    return;
  }
  opened_ = kNoChunk;
  content_ = {};  // before there is memory for the next one
  content_ = unpack(file_, readRecord(file_, chunks_[chunk].begin, rosbag::OP_CHUNK, "a chunk"));
  requireMessages(content_, chunks_[chunk].places);
  opened_ = chunk;
}

void BagFile::read(const BagEntry& entry, std::vector<std::uint8_t>& bytes)
{
  open(entry.chunk);
  const Record record = readRecord(content_, entry.place, rosbag::OP_MSG_DATA, "a message");
  bytes.resize(record.size);
  content_.copy(record.data, bytes.data(), bytes.size());
}

}  // namespace grasp_affordances
