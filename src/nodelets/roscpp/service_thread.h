#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>

#include <memory>

namespace grasp_affordances
{

/// A thread for services: a call that takes its time holds up neither clouds nor the services of other threads. Calls
/// of one thread are answered one after the other.
///
/// A service has to end in this order: calls that wait are told to return, stop(), then end() with its
/// ros::ServiceServer. What a call uses must still exist until stop() returns.
class ServiceThread
{
public:
  ServiceThread() : queue_(std::make_shared<ros::CallbackQueue>()), spinner_(1, queue_.get()) {}
  ~ServiceThread() { stop(); }

  /// A handle of the same namespace. What it advertises and subscribes is called back in the thread.
  ros::NodeHandle nodeHandle(const ros::NodeHandle& node_handle);

  void start() { spinner_.start(); }

  /// Returns when the call under way is answered; those that wait are not answered any more.
  void stop();

  /// Takes a service of the thread down, after stop().
  void end(ros::ServiceServer& server);

  /// As above, for an object that has the service in it: lets go of it.
  ///
  /// While ros::shutdown() is at work, both keep it, and with it the thread's queue, until the process ends.
  /// ros::shutdown() takes all services down itself, one after the other, and waits for their calls. One of those may
  /// be a manager's `unload_nodelet`, in which this runs: it must not wait for ros::shutdown() then, as
  /// ros::ServiceServer does.
  void end(std::shared_ptr<void> service);

private:
  const std::shared_ptr<ros::CallbackQueue> queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace grasp_affordances
