#pragma once

#include <OpenNI.h>

#include <memory>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The OpenNI2 runtime of this process, with its drivers. It is initialized for the first holder of the pointer, and
/// shut down when the last one releases it. Its methods may be called from any thread.
class OpenNi2Runtime
{
public:
  /// @throw DeviceError if the runtime does not start, for example without any driver.
  static std::shared_ptr<OpenNi2Runtime> get();

  ~OpenNi2Runtime();
  OpenNi2Runtime(const OpenNi2Runtime&) = delete;
  OpenNi2Runtime& operator=(const OpenNi2Runtime&) = delete;

  /// URIs of the connected devices, in the order in which they were connected.
  std::vector<std::string> deviceUris() const;

private:
  OpenNi2Runtime();
};

/// @throw DeviceError, with the text `what` and OpenNI2's reason, if the status is not OK.
void check(openni::Status status, const std::string& what);

}  // namespace grasp_affordances
