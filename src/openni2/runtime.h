#pragma once

#include <OpenNI.h>

#include <memory>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// The OpenNI2 runtime of this process, with its drivers, for as long as somebody holds it: it is initialized for the
/// first holder and shut down with the last one. Its methods may be called from any thread.
class OpenNi2Runtime
{
public:
  /// @throw DeviceError where the runtime does not start, as without any driver.
  static std::shared_ptr<OpenNi2Runtime> get();

  ~OpenNi2Runtime();
  OpenNi2Runtime(const OpenNi2Runtime&) = delete;
  OpenNi2Runtime& operator=(const OpenNi2Runtime&) = delete;

  /// URIs of the connected devices, in the order in which they were connected.
  std::vector<std::string> deviceUris() const;

private:
  OpenNi2Runtime();
};

/// @throw DeviceError with `what` and OpenNI2's reason, unless the status is OK.
void check(openni::Status status, const std::string& what);

}  // namespace grasp_affordances
