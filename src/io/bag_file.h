#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{

/// What one publisher sent on one topic.
struct BagConnection
{
  std::string topic, type, md5sum;  ///< whatever was recorded: a topic need not be a valid name of ROS
  std::size_t messages = 0;
};

/// Where a message is.
struct BagEntry
{
  std::uint64_t time;        ///< of recording, ns
  std::uint32_t connection;  ///< its number
  std::uint32_t place;       ///< of its record in the chunk, bytes
  std::size_t chunk;
};

/// A range of bytes of known size, in a file or in memory.
struct BagRegion
{
  std::uint64_t size = 0;
  std::function<void(std::uint64_t at, void* to, std::size_t size)> copy;
};

/// Reads the messages of one type from a bag of version 2.0. Nothing in the file is trusted: every length, count and
/// position must stay within what holds it; records must not overlap; each indexed message must exist, be indexed once,
/// and belong to a declared connection; names must not hold control characters; a compressed chunk must have the
/// content that it states. One thread at a time.
class BagFile
{
public:
  /// Reads the index, and the headers of all chunks. Unpacks nothing.
  /// @throw CloudError, without the path in its text, if the file is not such a bag, is damaged there, is encrypted, or
  /// has no index
  BagFile(const std::string& path, std::string type);
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// By their numbers, of all types.
  const std::map<std::uint32_t, BagConnection>& connections() const { return connections_; }

  /// The messages of the type, in the order in which the chunks and their indexes list them.
  const std::vector<BagEntry>& entries() const { return entries_; }

  /// The bytes of a message, as they were serialized. Its chunk is unpacked and checked, except where that is the chunk
  /// of the message before: one that is read in the order of recording is unpacked once, as a recorder writes it.
  /// @throw CloudError, without the path in its text, if the chunk or the message is damaged
  void read(const BagEntry& entry, std::vector<std::uint8_t>& bytes);

private:
  struct Chunk
  {
    std::uint64_t begin;                // in the file
    std::vector<std::uint32_t> places;  // of the messages of the type, ascending
  };

  void readIndex();
  void readConnections(std::uint32_t count);
  void readChunks(std::uint32_t count);
  std::uint64_t readChunk(std::uint64_t begin, std::size_t indexes);
  std::uint64_t readChunkIndex(std::uint64_t position, Chunk& chunk);
  void open(std::size_t chunk);

  const std::string type_;
  std::ifstream stream_;
  BagRegion file_;
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<BagEntry> entries_;
  std::vector<Chunk> chunks_;   // those with messages of the type
  std::uint64_t position_ = 0;  // in the index of the bag
  std::size_t opened_;          // the chunk whose content is at hand
  BagRegion content_;
};

}  // namespace grasp_affordances
