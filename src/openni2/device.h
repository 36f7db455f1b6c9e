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

/// Which device to open, and in which modes. For a recording only `id` counts: its modes are those that were recorded.
struct DeviceRequest
{
  std::string id;        ///< of a device, see deviceUri(), or the path of a recording, see isRecordingPath()
  FrameMode depth_mode;  ///< of the depth stream
  std::optional<FrameMode> color_mode;  ///< of the color stream; without one, no color stream is opened
  bool registration = false;            ///< the depth image is registered to the color image
};

/// A frame that was read. Its image is valid until the next call of Device::read().
struct DeviceFrame
{
  Sensor sensor;
  RawImage image;
  bool intact;              ///< see isIntact()
  std::uint64_t device_us;  ///< time of the frame by the device's clock, microseconds
};

/// An open camera or an open recording. A recording plays at its original speed while a stream runs. No method waits
/// without a limit, whatever the device does. Only connected() and atEnd() may be called from any thread.
class Device : openni::OpenNI::DeviceDisconnectedListener, openni::OpenNI::DeviceStateChangedListener
{
public:
  /// Opens the device and the requested streams, but does not start them. Switches mirroring off.
  /// @throw DeviceError if there is no such device, or if it refuses a mode or setting.
  /// @throw DeviceNotFound if no such device is connected.
  explicit Device(const DeviceRequest& request);
  ~Device() override;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const std::string& uri() const { return uri_; }
  const std::string& serial() const { return serial_; }  ///< empty if the device has none
  bool isRecording() const { return device_.isFile(); }
  bool has(Sensor sensor) const { return stream(sensor).video.isValid(); }
  const ImageLayout& layout(Sensor sensor) const { return stream(sensor).layout; }

  /// The field of view of a sensor's camera, as the device reports it. If it does not report that of the color camera,
  /// this is that of the depth camera.
  FieldOfView fieldOfView(Sensor sensor) const;

  /// Starts or stops a stream. @throw DeviceError if it does not start.
  void run(Sensor sensor, bool on);
  bool runs(Sensor sensor) const { return stream(sensor).runs; }

  /// Waits for the next frame of any running stream. At least one stream must run. Returns nothing after the timeout.
  /// @throw DeviceError if OpenNI2 reports an error.
  std::optional<DeviceFrame> read(std::chrono::milliseconds timeout);

  bool connected() const { return connected_; }  ///< false once the device was unplugged, and from then on
  bool atEnd() const { return at_end_; }  ///< a recording has played its last frame; some may still wait to be read

private:
  struct Stream
  {
    openni::VideoStream video;
    ImageLayout layout;
    std::optional<FieldOfView> field_of_view;  // that of the color camera is known even if its stream is closed
    bool runs = false;
  };

  Stream& stream(Sensor sensor) { return streams_[static_cast<std::size_t>(sensor)]; }
  const Stream& stream(Sensor sensor) const { return streams_[static_cast<std::size_t>(sensor)]; }
  void open(const std::string& id);
  void openStream(Sensor sensor, const FrameMode& mode);
  void close();
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override;

  const std::shared_ptr<OpenNi2Runtime> runtime_;  // the first member, so that it is released last
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
