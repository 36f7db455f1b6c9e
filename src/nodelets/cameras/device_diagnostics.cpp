#include "nodelets/cameras/device_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/time.h>

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

DeviceDiagnostics::DeviceDiagnostics(ros::NodeHandle nh, const std::string& name, double period)
    : name_(name.substr(name.find_first_not_of('/')) + ": device"),
      period_(period),
      publisher_(nh.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1))
{
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
  hardware_id_ = serial.empty() ? uri : serial;
}

bool DeviceDiagnostics::setState(DeviceState state, const std::string& message)
{
  const bool changed = state != state_;
  state_ = state;
  message_ = message;
  if (changed || !published_) {
    publish();
  }
  return changed;
}

void DeviceDiagnostics::update()
{
  if (Clock::now() - reported_ >= period_) {
    publish();
  }
}

void DeviceDiagnostics::publish()
{
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.name = name_;
  status.hardware_id = hardware_id_;
  report(status);
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  message.status.push_back(status);
  publisher_.publish(message);
  published_ = true;
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
