#pragma once

#include "virtual_device/virtual_bus.h"

#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <chrono>
#include <memory>

namespace grasp_affordances
{

/// A virtual Xtion that a program has opened.
///
/// Its clock starts at 0 when it is opened. Frame k (k = 1, 2, ...) has the time k / 30 s by that clock and shows
/// rendered frame k mod N of N; depth and color stream agree in this. A frame that is late by one period or more is
/// skipped. Nothing is sent before all N frames are rendered.
class VirtualDevice : public oni::driver::DeviceBase
{
public:
  explicit VirtualDevice(std::shared_ptr<const PluggedCamera> camera);

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  const PluggedCamera& camera() const { return *camera_; }
  bool registered() const { return registration_ == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR; }
  std::chrono::steady_clock::time_point opened() const { return opened_; }

private:
  const std::shared_ptr<const PluggedCamera> camera_;
  const std::chrono::steady_clock::time_point opened_;
  std::atomic<OniImageRegistrationMode> registration_{ONI_IMAGE_REGISTRATION_OFF};
};

}  // namespace grasp_affordances
