#include "virtual_device/virtual_device.h"

#include "virtual_device/property.h"
#include "virtual_device/virtual_stream.h"

#include <array>
#include <utility>

namespace grasp_affordances
{
namespace
{

OniVideoMode videoMode(OniPixelFormat format, int width, int height)
{
  return {format, width, height, 30};
}

/// The two sensors of every virtual device: depth and color.
std::array<OniSensorInfo, 2>& sensors()
{
  static std::array<OniVideoMode, 2> depth_modes = {videoMode(ONI_PIXEL_FORMAT_DEPTH_1_MM, 640, 480),
                                                    videoMode(ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240)};
  static std::array<OniVideoMode, 2> color_modes = {videoMode(ONI_PIXEL_FORMAT_RGB888, 640, 480),
                                                    videoMode(ONI_PIXEL_FORMAT_RGB888, 320, 240)};
  static std::array<OniSensorInfo, 2> infos = {OniSensorInfo{ONI_SENSOR_DEPTH, 2, depth_modes.data()},
                                               OniSensorInfo{ONI_SENSOR_COLOR, 2, color_modes.data()}};
  return infos;
}

}  // namespace

VirtualDevice::VirtualDevice(std::shared_ptr<const PluggedCamera> camera)
    : camera_(std::move(camera)), opened_(std::chrono::steady_clock::now())
{
}

OniStatus VirtualDevice::getSensorInfoList(OniSensorInfo** infos, int* count)
{
  *infos = sensors().data();
  *count = static_cast<int>(sensors().size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType sensor)
{
  for (const OniSensorInfo& info : sensors()) {
    if (info.sensorType == sensor)
      return new VirtualStream(*this, info);
  }
  return nullptr;
}

void VirtualDevice::destroyStream(oni::driver::StreamBase* stream)
{
  delete stream;
}

OniStatus VirtualDevice::setProperty(int id, const void* data, int size)
{
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION)
    return ONI_STATUS_NOT_IMPLEMENTED;
  OniImageRegistrationMode mode = ONI_IMAGE_REGISTRATION_OFF;
  const OniStatus status = receiveProperty(data, size, mode);
  if (status == ONI_STATUS_OK)
    registration_ = mode;
  return status;
}

OniStatus VirtualDevice::getProperty(int id, void* data, int* size)
{
  switch (id) {
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return answerProperty(registration_.load(), data, size);
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return answerProperty(camera_->settings.serial, data, size);
    default:
      return ONI_STATUS_NOT_IMPLEMENTED;
  }
}

OniBool VirtualDevice::isPropertySupported(int id)
{
  return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER;
}

OniBool VirtualDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode)
{
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

}  // namespace grasp_affordances
