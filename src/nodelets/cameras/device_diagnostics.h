#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

namespace grasp_affordances
{

enum class DeviceState
{
  waiting,       ///< the device is not connected yet, or it cannot be opened
  connected,     ///< frames arrive, or no topic has a subscriber
  stalled,       ///< no frames arrive; lasts until the next frame
  disconnected,  ///< the device was unplugged
  ended          ///< the recording has ended
};

/// The state as a word, such as "connected".
const char* deviceStateWord(DeviceState state);

/// Publishes the state of a camera and of its streams on /diagnostics. Not safe to use from several threads.
///
/// It replaces diagnostic_updater::Updater. That class reads its period from the parameter server repeatedly, and
/// throws if the parameter is not a valid number. It also publishes nothing while the ROS clock stands still or was set
/// back.
class DeviceDiagnostics
{
public:
  /// Counters of a stream, since the node started.
  struct Stream
  {
    std::string name;
    std::uint64_t frames = 0;
    std::uint64_t corrupt = 0;  // frames that were not intact, and not published

    std::uint64_t reported_frames = 0;
    std::uint64_t reported_corrupt = 0;
  };

  /// @param name full name of the node; the name of the status begins with it
  /// @param period time between messages by the wall clock, s
  DeviceDiagnostics(ros::NodeHandle nh, const std::string& name, double period);

  /// Adds a stream. The reference is valid as long as this object.
  Stream& addStream(const std::string& name);

  void setDevice(const std::string& uri, const std::string& serial);
  const std::string& uri() const { return uri_; }  ///< URI of the last device

  /// Sets the state. The first state and every change are published at once. Returns whether the state changed.
  bool setState(DeviceState state, const std::string& message);
  DeviceState state() const { return state_; }

  /// Publishes if the period has passed. Call it often.
  void update();

private:
  using Clock = std::chrono::steady_clock;

  void publish();
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  const std::string name_;  // name of the status
  const std::chrono::duration<double> period_;
  ros::Publisher publisher_;
  std::string hardware_id_ = "none";
  std::deque<Stream> streams_;
  DeviceState state_ = DeviceState::waiting;
  std::string message_ = "not opened yet";
  std::string uri_;
  std::string serial_;
  bool published_ = false;
  Clock::time_point reported_ = Clock::now();
};

}  // namespace grasp_affordances
