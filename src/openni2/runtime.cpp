#include "openni2/runtime.h"

#include "openni2/device_error.h"

#include <mutex>
#include <regex>

namespace grasp_affordances
{
namespace
{

/// OpenNI2 counts the calls of initialize() and shutdown(), but the counter is not safe for several threads.
std::mutex& runtimeMutex()
{
  static std::mutex mutex;
  return mutex;
}

}  // namespace

std::shared_ptr<OpenNi2Runtime> OpenNi2Runtime::get()
{
  static std::weak_ptr<OpenNi2Runtime> current;
  const std::lock_guard<std::mutex> lock(runtimeMutex());
  std::shared_ptr<OpenNi2Runtime> runtime = current.lock();
  if (!runtime) {
    runtime.reset(new OpenNi2Runtime);
    current = runtime;
  }
  return runtime;
}

OpenNi2Runtime::OpenNi2Runtime()
{
  try {
    check(openni::OpenNI::initialize(), "OpenNI2 does not start");
  } catch (const DeviceError&) {
    openni::OpenNI::shutdown();  // the failed call was counted; without this the next one would "succeed" without any
                                 // driver
    throw;
  }
}

OpenNi2Runtime::~OpenNi2Runtime()
{
  const std::lock_guard<std::mutex> lock(runtimeMutex());
  openni::OpenNI::shutdown();
}

std::vector<std::string> OpenNi2Runtime::deviceUris() const
{
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::vector<std::string> uris;
  for (int i = 0; i < devices.getSize(); ++i) {
    uris.emplace_back(devices[i].getUri());
  }
  return uris;
}

void check(openni::Status status, const std::string& what)
{
  if (status == openni::STATUS_OK) {
    return;
  }
  static const std::regex space("\\s+");
  static const std::regex ends("^ | $");
  const std::string reason =
      std::regex_replace(std::regex_replace(openni::OpenNI::getExtendedError(), space, " "), ends, "");
  throw DeviceError(reason.empty() ? what : what + ": " + reason);
}

}  // namespace grasp_affordances
