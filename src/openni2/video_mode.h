#pragma once

#include <OpenNI.h>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// Size and rate of the frames of a stream.
struct FrameMode
{
  int width = 640;
  int height = 480;
  int rate = 30;  ///< Hz
};

/// Reads words such as 640x480@30. @throw std::invalid_argument that says what is expected.
FrameMode frameModeFromWord(const std::string& word);

/// The other way.
std::string frameModeWord(const FrameMode& mode);
std::string frameModeWord(const openni::VideoMode& mode);

/// The one of a sensor's modes that has the wanted size and rate, and a pixel format that this package reads: depth in
/// millimetres, else in tenths of them; color as RGB888. A recording may have one sensor's in the other's stream.
/// @throw DeviceError, which begins with `sensor`, with a list of the modes that could have been asked for.
const openni::VideoMode& supportedVideoMode(const std::string& sensor, openni::SensorType type,
                                            const std::vector<openni::VideoMode>& modes, const FrameMode& wanted);

}  // namespace grasp_affordances
