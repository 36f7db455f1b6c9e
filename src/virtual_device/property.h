#pragma once

#include <OniCAPI.h>

#include <cstring>
#include <string>

namespace grasp_affordances
{

/// Writes the value of a property into OpenNI2's buffer. `size` is the number of bytes that the caller expects.
template <class T>
OniStatus answerProperty(const T& value, void* data, const int* size)
{
  if (*size != static_cast<int>(sizeof(T)))
    return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  return ONI_STATUS_OK;
}

/// As above, with a terminating zero. The buffer may be larger than the text.
inline OniStatus answerProperty(const std::string& value, void* data, int* size)
{
  const auto needed = static_cast<int>(value.size() + 1);
  if (*size < needed)
    return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, value.c_str(), needed);
  *size = needed;
  return ONI_STATUS_OK;
}

template <class T>
OniStatus receiveProperty(const void* data, int size, T& value)
{
  if (size != static_cast<int>(sizeof(T)))
    return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof(T));
  return ONI_STATUS_OK;
}

}  // namespace grasp_affordances
