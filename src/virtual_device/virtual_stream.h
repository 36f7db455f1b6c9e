#pragma once

#include "virtual_device/device_list.h"

#include <Driver/OniDriverAPI.h>

#include <condition_variable>
#include <mutex>
#include <thread>

namespace grasp_affordances
{

class VirtualDevice;

/// Depth (640x480 or 320x240, millimetres) or color (the same sizes, RGB), 30 frames per second. Like the streams of a
/// real Xtion it is mirrored until it is told not to be. Holds no lock while OpenNI takes a frame.
class VirtualStream : public oni::driver::StreamBase
{
public:
  /// Both must outlive the stream.
  VirtualStream(const VirtualDevice& device, const OniSensorInfo& sensor);
  ~VirtualStream() override;

  OniStatus start() override;

  /// Returns when the last frame has been taken.
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
  int sent_ = 0;  // of a device that vanishes; of the thread

  std::mutex mutex_;  // of what follows
  OniVideoMode mode_;
  bool mirrored_ = true;
  bool stopping_ = false;
  std::condition_variable stop_asked_;
  std::thread thread_;
};

}  // namespace grasp_affordances
