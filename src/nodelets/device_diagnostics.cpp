#include "nodelets/device_diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

namespace grasp_affordances
{
namespace
{

using diagnostic_msgs::DiagnosticStatus;

std::uint8_t level(DeviceState state)
{
  switch (state) {
    case DeviceState::waiting:
      return DiagnosticStatus::WARN;
    case DeviceState::stalled:
    case DeviceState::disconnected:
      return DiagnosticStatus::ERROR;
    default:
      return DiagnosticStatus::OK;
  }
}

}  // namespace

const char* deviceStateWord(DeviceState state)
{
  static constexpr const char* words[] = {"waiting", "connected", "stalled", "disconnected", "ended"};
  return words[static_cast<int>(state)];
}

DeviceDiagnostics::DeviceDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                                     const std::string& name)
    : updater_(nh, private_nh, name)
{
  updater_.setHardwareID("none");
  updater_.add("device", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
}

DeviceDiagnostics::Stream& DeviceDiagnostics::addStream(const std::string& name)
{
  streams_.emplace_back();
  streams_.back().name = name;
  return streams_.back();
}

void DeviceDiagnostics::setDevice(const std::string& uri, const std::string& serial)
{
  uri_ = uri;
  serial_ = serial;
  updater_.setHardwareID(serial.empty() ? uri : serial);
}

bool DeviceDiagnostics::setState(DeviceState state, const std::string& message)
{
  const bool changed = state != state_;
  state_ = state;
  message_ = message;
  if (changed) {
    updater_.force_update();
  }
  return changed;
}

void DeviceDiagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - reported_).count();
  reported_ = now;

  status.summary(level(state_), message_);
  status.add("state", deviceStateWord(state_));
  status.add("uri", uri_);
  status.add("serial", serial_);
  for (Stream& stream : streams_) {
    status.addf(stream.name + " rate [Hz]", "%.1f", (stream.frames - stream.reported_frames) / seconds);
    status.add(stream.name + " frames", stream.frames);
    status.add(stream.name + " corrupt frames", stream.corrupt);
    if (stream.corrupt > stream.reported_corrupt) {
      status.mergeSummary(DiagnosticStatus::WARN, "corrupt " + stream.name + " frames are skipped");
    }
    stream.reported_frames = stream.frames;
    stream.reported_corrupt = stream.corrupt;
  }
}

}  // namespace grasp_affordances
