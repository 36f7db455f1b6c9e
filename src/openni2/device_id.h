#pragma once

#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Whether an id is the path of a recording: it ends in .oni.
bool isRecordingPath(const std::string& id);

/// The URI of the connected device that an id means. An empty id: the first one. #2: the second one. Else a URI, or a
/// part of one that no other device has (an Xtion's is vendor/product@bus/address), or a serial number.
/// @param uris of the connected devices, in the order in which they were connected
/// @param serial_of the serial number of the device with a URI; empty where it has none or does not tell. Asked only
/// where the id is none of the others.
/// @throw DeviceNotFound with a list of the connected devices.
std::string deviceUri(const std::string& id, const std::vector<std::string>& uris,
                      const std::function<std::string(const std::string&)>& serial_of);

}  // namespace grasp_affordances
