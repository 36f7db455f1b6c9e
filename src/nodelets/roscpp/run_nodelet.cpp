#include "nodelets/roscpp/run_nodelet.h"

#include <nodelet/loader.h>
#include <ros/ros.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

namespace grasp_affordances
{
namespace
{

std::atomic<bool> loaded{false};
std::atomic<int> interruptions{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free, "for signal handlers");

void interrupt(int /*signal*/)
{
  if (loaded) {
    ros::requestShutdown();  // sets a flag
  } else if (++interruptions > 1) {
    _exit(1);
  }
}

/// Returns whether there is one, sooner or later; false: interrupted.
bool waitForMaster()
{
  constexpr double kPause = 0.1;  // s
  while (!ros::master::check()) {
    ROS_WARN_STREAM_ONCE("waits for the master at " << ros::master::getURI());
    if (interruptions > 0) {
      return false;
    }
    ros::WallDuration(kPause).sleep();
  }
  return interruptions == 0;
}

}  // namespace

int runNodelet(int argc, char** argv, const std::string& name, const std::string& type)
{
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  if (!waitForMaster()) {
    return 0;
  }
  const bool provide_ros_api = false;
  nodelet::Loader loader(provide_ros_api);
  if (!loader.load(ros::this_node::getName(), type, ros::names::getRemappings(), {})) {
    return 1;
  }
  loaded = true;
  if (interruptions == 0) {
    ros::spin();
  }
  return 0;
}

}  // namespace grasp_affordances
