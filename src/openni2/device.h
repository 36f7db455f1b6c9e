#pragma once

#include "openni2/depth_image.h"
#include "openni2/field_of_view.h"
#include "openni2/runtime.h"
#include "openni2/video_mode.h"

#include <OpenNI.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace grasp_affordances
{

enum class Sensor
{
  depth,
  color
};

/// What is asked of a camera or, but for its id, disregarded by a recording, which is what it is.
struct DeviceRequest
{
  std::string id;                       ///< see deviceUri(), or the path of a recording, see isRecordingPath()
  FrameMode depth_mode;                 ///< of the depth stream
  std::optional<FrameMode> color_mode;  ///< of the color stream; none: it is not opened
  bool registration = false;            ///< depth as the color camera would see it
};

/// A frame while it lives. The next call of Device::read() ends it.
struct DeviceFrame
{
  Sensor sensor;
  RawImage image;
  bool intact;              ///< see isIntact()
  std::uint64_t device_us;  ///< by the device's clock
};

/// An open camera, or an open recording, which plays at the speed at which it was recorded while a stream runs. Nothing
/// here waits for ever, whatever the device does. Of its methods, connected() and atEnd() may be called from any
/// thread.
class Device : openni::OpenNI::DeviceDisconnectedListener, openni::OpenNI::DeviceStateChangedListener
{
public:
  /// Opens the device and the streams that are asked for; none of them runs yet. Mirroring is switched off.
  /// @throw DeviceError where there is no such device, or it refuses something.
  explicit Device(const DeviceRequest& request);
  ~Device() override;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const std::string& uri() const { return uri_; }
  const std::string& serial() const { return serial_; }  ///< empty where the device has none
  bool isRecording() const { return device_.isFile(); }
  bool has(Sensor sensor) const { return stream(sensor).video.isValid(); }
  const ImageLayout& layout(Sensor sensor) const { return stream(sensor).layout; }

  /// As the device reports it of a sensor's camera; where the color camera's is unknown, that of the depth camera.
  FieldOfView fieldOfView(Sensor sensor) const;

  /// Starts or stops a stream. @throw DeviceError where it does not start.
  void run(Sensor sensor, bool on);
  bool runs(Sensor sensor) const { return stream(sensor).runs; }

  /// Waits for the next frame of the streams that run; at least one must. None after the timeout.
  /// @throw DeviceError where OpenNI2 fails.
  std::optional<DeviceFrame> read(std::chrono::milliseconds timeout);

  bool connected() const { return connected_; }  ///< false for ever once it was pulled out
  bool atEnd() const { return at_end_; }         ///< a recording has nothing more to play but what waits to be read

private:
  struct Stream
  {
    openni::VideoStream video;
    ImageLayout layout;
    std::optional<FieldOfView> field_of_view;  // of the color camera also where its stream stays closed
    bool runs = false;
  };

  Stream& stream(Sensor sensor) { return streams_[static_cast<std::size_t>(sensor)]; }
  const Stream& stream(Sensor sensor) const { return streams_[static_cast<std::size_t>(sensor)]; }
  void open(const std::string& id);
  void openStream(Sensor sensor, const FrameMode& mode);
  void close();
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override;

  const std::shared_ptr<OpenNi2Runtime> runtime_;  // first: it is given back last
  std::string uri_;
  std::string serial_;
  bool listens_ = false;
  std::atomic<bool> connected_{true};
  std::atomic<bool> at_end_{false};
  openni::Device device_;
  std::array<Stream, 2> streams_;
  openni::VideoFrameRef frame_;
};

}  // namespace grasp_affordances
