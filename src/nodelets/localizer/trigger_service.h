#pragma once

#include "grasp_affordances/LocalizeNext.h"
#include "grasp_affordances/RegionOfInterest.h"
#include "nodelets/localizer/localization_publishers.h"
#include "nodelets/roscpp/service_thread.h"

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace grasp_affordances
{

/// The service ~trigger (LocalizeNext): a call waits for the next cloud, is given the turn of that one or, where it was
/// replaced by a newer one before its turn, of the newer one, and answered with what was published for it. One call at
/// a time; others wait for it.
///
/// The call runs in a thread of its own; arrives() may come from any thread; take(), answer() and fail() from one: the
/// worker's.
class TriggerService
{
public:
  using Clock = LocalizationPublishers::Clock;

  ~TriggerService() { close(); }

  /// @param awaited  what a call waits for, in words
  /// @param demand   is told whether a call needs clouds to come, and returns why they cannot, see
  /// InputDemand::demand()
  void advertise(const ros::NodeHandle& private_node_handle, const std::string& awaited,
                 std::function<std::string(bool)> demand);

  /// Answers the call that waits, with a failure, and ends the service.
  void close();

  /// Whether a call waited for the cloud that has come in at that time: once for every call.
  bool arrives(Clock::time_point arrival);

  /// The region of the call that this cloud, whose turn it is, is for; nothing where it is for none.
  std::optional<RegionOfInterest> take(Clock::time_point arrival);

  /// Answers the call that was taken; without one nothing happens.
  void answer(const LocalizationPublishers::Messages& messages);
  void fail(const std::string& reason);

private:
  enum class State
  {
    idle,      // there is no call
    waiting,   // for a cloud
    arrived,   // the cloud waits for its turn
    taken,     // it is worked on
    answered,  // the call can return
  };

  bool call(LocalizeNext::Request& request, LocalizeNext::Response& response);
  LocalizeNext::Response waitForAnswer(const RegionOfInterest& region, double timeout);
  void finish(LocalizeNext::Response response);

  std::string awaited_;
  std::function<std::string(bool)> demand_;

  std::mutex mutex_;  // guards the following
  std::condition_variable changed_;
  bool closed_ = false;
  State state_ = State::idle;
  RegionOfInterest region_;
  Clock::time_point arrival_;
  LocalizeNext::Response response_;

  ros::ServiceServer server_;
  ServiceThread thread_;  // last: it stops before the rest goes
};

}  // namespace grasp_affordances
