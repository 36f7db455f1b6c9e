#pragma once

#include <string>

namespace grasp_affordances
{

/// Proves what librosbag takes on trust when it reads PointCloud2 messages from a bag of version 2.0: that every
/// length, count and position in it stays within the file, that records do not overlap, that indexed messages exist,
/// once, and are of connections that are declared, and that compressed chunks hold what they claim. Names of topics and
/// types are printable then. Reads the index, and of chunks with clouds in them the headers of these; compressed ones
/// are unpacked for that, one at a time.
/// @throw CloudError, without the path, for another file; for an encrypted bag and one without an index, too
void checkBag(const std::string& path);

}  // namespace grasp_affordances
