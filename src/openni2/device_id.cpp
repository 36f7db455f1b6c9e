#include "openni2/device_id.h"

#include "openni2/device_error.h"

#include <algorithm>
#include <regex>

namespace grasp_affordances
{
namespace
{

[[noreturn]] void refuse(const std::string& reason, const std::vector<std::string>& uris)
{
  std::string text = reason + "; connected:";
  for (const std::string& uri : uris) {
    text += " " + uri;
  }
  throw DeviceNotFound(text);
}

}  // namespace

bool isRecordingPath(const std::string& id)
{
  static const std::string ending = ".oni";
  return id.size() > ending.size() && id.compare(id.size() - ending.size(), ending.size(), ending) == 0;
}

std::string deviceUri(const std::string& id, const std::vector<std::string>& uris,
                      const std::function<std::string(const std::string&)>& serial_of)
{
  if (uris.empty()) {
    throw DeviceNotFound("none is connected");
  }
  if (id.empty()) {
    return uris.front();
  }
  static const std::regex number("#([1-9][0-9]{0,3})");
  std::smatch match;
  if (std::regex_match(id, match, number)) {
    const std::size_t position = std::stoul(match[1]);
    if (position > uris.size()) {
      refuse("no device is " + id, uris);
    }
    return uris[position - 1];
  }
  if (std::find(uris.begin(), uris.end(), id) != uris.end()) {
    return id;
  }
  std::vector<std::string> found;
  const auto has_part = [&](const std::string& uri) { return uri.find(id) != std::string::npos; };
  std::copy_if(uris.begin(), uris.end(), std::back_inserter(found), has_part);
  if (found.empty()) {
    const auto has_serial = [&](const std::string& uri) { return serial_of(uri) == id; };
    std::copy_if(uris.begin(), uris.end(), std::back_inserter(found), has_serial);
  }
  if (found.size() != 1) {
    refuse((found.empty() ? "no device is " : "more than one device is ") + id, uris);
  }
  return found.front();
}

}  // namespace grasp_affordances
