#pragma once

#include <string>

namespace grasp_affordances
{

/// Whether somebody listens at the URI of a node, as the master gives it: "http://host:port/". A node that died without
/// unregistering does not, nor is a host found whose name is known on its own machine only. Gives up after half a
/// second, but waits for the system to look the host's name up.
bool isReachableAt(const std::string& uri);

}  // namespace grasp_affordances
