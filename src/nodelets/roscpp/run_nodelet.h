#pragma once

#include <string>

namespace grasp_affordances
{

/// The main function of a process that has one nodelet: until SIGINT, SIGTERM or a call of roscpp's own `shutdown`.
///
/// Unlike roscpp's handler, which shuts ROS down below whatever is running, signals wait until the nodelet is loaded:
/// topics that are advertised during a shutdown come out empty, and libraries assert that they are not. A second signal
/// ends a process that waits for its master in the middle of loading.
/// @param name  of the node, where no other is given on the command line
/// @return exit status: 1 where the nodelet refused to start
int runNodelet(int argc, char** argv, const std::string& name, const std::string& type);

}  // namespace grasp_affordances
