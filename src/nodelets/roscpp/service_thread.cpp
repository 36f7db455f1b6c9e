#include "nodelets/roscpp/service_thread.h"

#include <ros/init.h>

#include <mutex>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// Never destroyed, as ros::shutdown() may still be at work when the process ends.
void keepForEver(std::shared_ptr<void> object)
{
  static auto* const mutex = new std::mutex;
  static auto* const kept = new std::vector<std::shared_ptr<void>>;
  const std::lock_guard<std::mutex> lock(*mutex);
  kept->push_back(std::move(object));
}

}  // namespace

ros::NodeHandle ServiceThread::nodeHandle(const ros::NodeHandle& node_handle)
{
  ros::NodeHandle result(node_handle);
  result.setCallbackQueue(queue_.get());
  return result;
}

void ServiceThread::stop()
{
  spinner_.stop();
  queue_->disable();
  queue_->clear();
}

void ServiceThread::end(ros::ServiceServer& server)
{
  end(std::make_shared<ros::ServiceServer>(std::exchange(server, ros::ServiceServer())));
}

void ServiceThread::end(std::shared_ptr<void> service)
{
  const bool at_work = ros::isShuttingDown() && ros::isStarted();  // when it is done, ROS counts as not started
  if (at_work) {
    keepForEver(std::move(service));
    keepForEver(queue_);
  }
}

}  // namespace grasp_affordances
