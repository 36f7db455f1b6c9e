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
  waiting,       ///< no such device yet, or it cannot be opened
  connected,     ///< frames come, or nobody wants any
  stalled,       ///< frames do not come; until one comes
  disconnected,  ///< it was there, and was pulled out
  ended          ///< a recording is over
};

/// The word that stands for a state.
const char* deviceStateWord(DeviceState state);

/// The state of a camera and its streams on /diagnostics. Not safe to use from several threads.
///
/// In place of diagnostic_updater::Updater, which reads its period from the parameter server again and again and
/// throws at one that it cannot compute with, and which falls silent while the ROS clock is set back or stands still.
class DeviceDiagnostics
{
public:
  /// What is counted of a stream, since the node began.
  struct Stream
  {
    std::string name;
    std::uint64_t frames = 0;
    std::uint64_t corrupt = 0;  // frames that were skipped

    std::uint64_t reported_frames = 0;
    std::uint64_t reported_corrupt = 0;
  };

  /// @param name of the node, full: what the name of the status begins with
  /// @param period s of the wall clock, between messages
  DeviceDiagnostics(ros::NodeHandle nh, const std::string& name, double period);

  /// Valid as long as this object.
  Stream& addStream(const std::string& name);

  void setDevice(const std::string& uri, const std::string& serial);
  const std::string& uri() const { return uri_; }  ///< of the last device

  /// The first state, and a change of it, are published at once. Returns whether there was a change.
  bool setState(DeviceState state, const std::string& message);
  DeviceState state() const { return state_; }

  /// Publishes when the period has passed; to be called often.
  void update();

private:
  using Clock = std::chrono::steady_clock;

  void publish();
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  const std::string name_;  // of the status
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
