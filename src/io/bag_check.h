#pragma once

#include <string>

namespace grasp_affordances
{

/// Checks a bag of version 2.0 for everything that librosbag assumes when it reads PointCloud2 messages:
///  - every length, count and position stays within the file, and records do not overlap;
///  - each indexed message exists, is indexed once, and belongs to a declared connection;
///  - compressed chunks have the content that they state;
///  - names of topics and types are printable.
/// It reads the index, and the headers of messages in chunks with clouds. Compressed chunks are decompressed for this,
/// one at a time.
/// @throw CloudError, without the path in its text, if a check fails, if the file is not such a bag, if the bag is
/// encrypted, or if it has no index
void checkBag(const std::string& path);

}  // namespace grasp_affordances
