#pragma once

#include <stdexcept>

namespace grasp_affordances
{

/// A camera or the OpenNI2 runtime fails to do what was requested. what() names the request, and the reason if OpenNI2
/// gives one.
class DeviceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The requested device is not connected.
class DeviceNotFound : public DeviceError
{
public:
  using DeviceError::DeviceError;
};

}  // namespace grasp_affordances
