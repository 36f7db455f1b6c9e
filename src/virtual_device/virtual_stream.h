#pragma once

#include "virtual_device/device_list.h"

#include <Driver/OniDriverAPI.h>

#include <condition_variable>
#include <mutex>
#include <thread>

namespace grasp_affordances
{

class VirtualDevice;

/// A stream of depth images (640x480 or 320x240, millimetres) or color images (the same sizes, RGB), 30 per second.
/// Like the streams of a real Xtion it is mirrored by default. It holds no lock while it passes a frame to OpenNI.
class VirtualStream : public oni::driver::StreamBase
{
public:
  /// Both must outlive the stream.
  VirtualStream(const VirtualDevice& device, const OniSensorInfo& sensor);
  ~VirtualStream() override;

  OniStatus start() override;

  /// Returns after OpenNI has received the last frame.
  void stop() override;

  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;

private:
  OniStatus setVideoMode(const OniVideoMode& mode);
  void run();
  void send(int frame_index, VirtualDeviceState state);
  void fill(OniFrame& frame, int frame_index);

  const VirtualDevice& device_;
  const OniSensorInfo& sensor_;
  int sent_ = 0;  // frames of a device that vanishes; used by the thread only

  std::mutex mutex_;  // guards the members below
  OniVideoMode mode_;
  bool mirrored_ = true;
  bool stopping_ = false;
  std::condition_variable stop_asked_;
  std::thread thread_;
};

}  // namespace grasp_affordances
