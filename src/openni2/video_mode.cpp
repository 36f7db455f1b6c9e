#include "openni2/video_mode.h"

#include "openni2/device_error.h"

#include <algorithm>
#include <regex>
#include <set>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

/// The pixel formats of a sensor that this package reads, best first.
std::vector<openni::PixelFormat> readableFormats(openni::SensorType type)
{
  if (type == openni::SENSOR_DEPTH) {
    return {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM};
  }
  return {openni::PIXEL_FORMAT_RGB888};
}

}  // namespace

FrameMode frameModeFromWord(const std::string& word)
{
  static const std::regex pattern("([1-9][0-9]{0,3})x([1-9][0-9]{0,3})@([1-9][0-9]{0,2})");
  std::smatch match;
  if (!std::regex_match(word, match, pattern)) {
    throw std::invalid_argument("a mode such as 640x480@30");
  }
  return {std::stoi(match[1]), std::stoi(match[2]), std::stoi(match[3])};
}

std::string frameModeWord(const FrameMode& mode)
{
  return std::to_string(mode.width) + "x" + std::to_string(mode.height) + "@" + std::to_string(mode.rate);
}

std::string frameModeWord(const openni::VideoMode& mode)
{
  return frameModeWord({mode.getResolutionX(), mode.getResolutionY(), mode.getFps()});
}

const openni::VideoMode& supportedVideoMode(const std::string& sensor, openni::SensorType type,
                                            const std::vector<openni::VideoMode>& modes, const FrameMode& wanted)
{
  const std::vector<openni::PixelFormat> formats = readableFormats(type);
  const auto rank = [&](const openni::VideoMode& mode) {  // smaller is better
    return std::find(formats.begin(), formats.end(), mode.getPixelFormat());
  };
  const openni::VideoMode* best = nullptr;
  std::set<std::string> readable;
  for (const openni::VideoMode& mode : modes) {
    if (rank(mode) == formats.end()) {
      continue;
    }
    readable.insert(frameModeWord(mode));
    if (frameModeWord(mode) == frameModeWord(wanted) && (best == nullptr || rank(mode) < rank(*best))) {
      best = &mode;
    }
  }
  if (best == nullptr) {
    std::string text = sensor + ": no mode " + frameModeWord(wanted) + " among";
    for (const std::string& word : readable) {
      text += " " + word;
    }
    throw DeviceError(readable.empty() ? text + " none that can be read" : text);
  }
  return *best;
}

}  // namespace grasp_affordances
