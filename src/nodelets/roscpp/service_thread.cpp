#include "nodelets/roscpp/service_thread.h"

namespace grasp_affordances
{

ros::NodeHandle ServiceThread::nodeHandle(const ros::NodeHandle& node_handle)
{
  ros::NodeHandle result(node_handle);
  result.setCallbackQueue(&queue_);
  return result;
}

void ServiceThread::stop()
{
  spinner_.stop();
  queue_.disable();
  queue_.clear();
}

}  // namespace grasp_affordances
