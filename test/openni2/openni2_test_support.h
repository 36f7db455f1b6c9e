#pragma once

#include "openni2/virtual_bus_file.h"

#include <OpenNI.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{

constexpr std::chrono::seconds kPatience(20);

/// A frame, out of the runtime's hands.
struct ReceivedFrame
{
  int index;
  std::uint64_t timestamp;  // us
  int width;
  int height;
  std::string data;

  std::vector<std::uint16_t> depth() const
  {
    std::vector<std::uint16_t> pixels(data.size() / 2);
    std::memcpy(pixels.data(), data.data(), 2 * pixels.size());
    return pixels;
  }
};

/// One that comes within the timeout. @return whether there was one
inline bool receive(openni::VideoStream& stream, ReceivedFrame& received, std::chrono::milliseconds timeout = kPatience)
{
  openni::VideoStream* streams[] = {&stream};
  int ready = -1;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, static_cast<int>(timeout.count())) != openni::STATUS_OK)
    return false;
  openni::VideoFrameRef frame;
  if (stream.readFrame(&frame) != openni::STATUS_OK)
    return false;
  received = {frame.getFrameIndex(), frame.getTimestamp(), frame.getWidth(), frame.getHeight(),
              std::string(static_cast<const char*>(frame.getData()), frame.getDataSize())};
  return true;
}

inline std::vector<ReceivedFrame> receive(openni::VideoStream& stream, std::size_t count)
{
  std::vector<ReceivedFrame> frames(count);
  for (ReceivedFrame& frame : frames) {
    if (!receive(stream, frame)) {
      ADD_FAILURE() << "no frame: " << openni::OpenNI::getExtendedError();
      break;
    }
  }
  return frames;
}

/// Whether a stream falls silent: no frame for 0.3 s, ten periods.
inline bool fallsSilent(openni::VideoStream& stream)
{
  const auto end = std::chrono::steady_clock::now() + kPatience;
  ReceivedFrame frame;
  while (std::chrono::steady_clock::now() < end) {
    if (!receive(stream, frame, std::chrono::milliseconds(300)))
      return true;
  }
  return false;
}

/// Keeps what is plugged in and unplugged.
class BusListener : public openni::OpenNI::DeviceConnectedListener, public openni::OpenNI::DeviceDisconnectedListener
{
public:
  BusListener()
  {
    openni::OpenNI::addDeviceConnectedListener(this);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }

  ~BusListener() override
  {
    openni::OpenNI::removeDeviceConnectedListener(this);
    openni::OpenNI::removeDeviceDisconnectedListener(this);
  }

  void onDeviceConnected(const openni::DeviceInfo* info) override { note("+", info); }
  void onDeviceDisconnected(const openni::DeviceInfo* info) override { note("-", info); }

  /// All so far, of which there are that many at least unless patience runs out; each is + or - and a URI.
  std::vector<std::string> wait(std::size_t count)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    arrival_.wait_for(lock, kPatience, [&] { return events_.size() >= count; });
    return events_;
  }

private:
  void note(const std::string& kind, const openni::DeviceInfo* info)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    events_.push_back(kind + info->getUri());
    arrival_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable arrival_;
  std::vector<std::string> events_;
};

/// The runtime with the virtual driver and a list of devices.
class OpenNi2Test : public testing::Test
{
protected:
  void initialize(const std::string& devices)
  {
    bus_.write(devices);
    require(openni::OpenNI::initialize());
  }

  void TearDown() override { openni::OpenNI::shutdown(); }

  /// Ends the test, as a failure, unless the status is OK.
  static void require(openni::Status status)
  {
    if (status != openni::STATUS_OK)
      throw std::runtime_error(openni::OpenNI::getExtendedError());
  }

  static void open(openni::Device& device, const char* uri) { require(device.open(uri)); }

  /// Not mirrored.
  static void create(openni::VideoStream& stream, const openni::Device& device, openni::SensorType sensor)
  {
    require(stream.create(device, sensor));
    require(stream.setMirroringEnabled(false));
  }

  static void start(openni::VideoStream& stream, const openni::Device& device, openni::SensorType sensor)
  {
    create(stream, device, sensor);
    require(stream.start());
  }

  VirtualBusFile bus_;
};

}  // namespace grasp_affordances
