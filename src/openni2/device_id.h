#pragma once

#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Whether an id is the path of a recording, which ends in .oni.
bool isRecordingPath(const std::string& id);

/// Finds the connected device with an id, and returns its URI. The id is one of:
///  - empty: the first device;
///  - #2: the second device, and so on;
///  - a URI, or a part of a URI that no other device has (an Xtion's is vendor/product@bus/address);
///  - a serial number.
/// @param uris of the connected devices, in the order in which they were connected
/// @param serial_of returns the serial number of the device with a URI, or an empty string if that is unknown. It is
/// called only if the id is none of the others.
/// @throw DeviceNotFound if no device, or more than one, has the id; it lists the connected devices.
std::string deviceUri(const std::string& id, const std::vector<std::string>& uris,
                      const std::function<std::string(const std::string&)>& serial_of);

}  // namespace grasp_affordances
