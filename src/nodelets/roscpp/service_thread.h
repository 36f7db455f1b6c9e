#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

namespace grasp_affordances
{

/// A thread for services: a call that takes its time holds up neither clouds nor the services of other threads. Calls
/// of one thread are answered one after the other.
///
/// A service has to end in this order: calls that wait are told to return, stop(), then its ros::ServiceServer. What a
/// call uses must still exist until stop() returns.
class ServiceThread
{
public:
  ServiceThread() : spinner_(1, &queue_) {}
  ~ServiceThread() { stop(); }

  /// A handle of the same namespace. What it advertises and subscribes is called back in the thread.
  ros::NodeHandle nodeHandle(const ros::NodeHandle& node_handle);

  void start() { spinner_.start(); }

  /// Returns when the call under way is answered; those that wait are not answered any more.
  void stop();

private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace grasp_affordances
