#include "virtual_device/virtual_bus.h"
#include "virtual_device/virtual_device.h"

#include <Driver/OniDriverAPI.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

namespace grasp_affordances
{

/// OpenNI2 driver for virtual devices. The environment variable GRASP_AFFORDANCES_VIRTUAL_DEVICES is the path of the
/// file that lists them, see VirtualBus. The path must be absolute, because OpenNI changes the working directory.
class VirtualDriver : public oni::driver::DriverBase
{
public:
  using DriverBase::DriverBase;

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override
  {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
    const char* list_file = std::getenv("GRASP_AFFORDANCES_VIRTUAL_DEVICES");
    try {
      bus_ = std::make_shared<VirtualBus>(
          list_file != nullptr ? list_file : "", [=](const OniDeviceInfo& info) { connected(&info, cookie); },
          [=](const OniDeviceInfo& info) { disconnected(&info, cookie); });
      bus_->start();
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return ONI_STATUS_ERROR;
    }
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override
  {
    const auto camera = bus_->find(uri);
    return camera ? new VirtualDevice(camera) : nullptr;
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override
  {
    if (bus_)
      bus_->stop();
    bus_.reset();
  }

private:
  std::shared_ptr<VirtualBus> bus_;
};

}  // namespace grasp_affordances

// These macros are in headers of OpenNI that are not installed.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

ONI_EXPORT_DRIVER(grasp_affordances::VirtualDriver)
