#pragma once

#include <stdexcept>

namespace grasp_affordances
{

/// A camera, or the OpenNI2 runtime, does not do what is asked of it; what() says what and, where OpenNI2 tells, why.
class DeviceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// There is no such device.
class DeviceNotFound : public DeviceError
{
public:
  using DeviceError::DeviceError;
};

}  // namespace grasp_affordances
