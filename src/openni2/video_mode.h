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

/// Parses a word such as 640x480@30. @throw std::invalid_argument; what() describes a valid word.
FrameMode frameModeFromWord(const std::string& word);

/// The word for a mode, such as 640x480@30.
std::string frameModeWord(const FrameMode& mode);
std::string frameModeWord(const openni::VideoMode& mode);

/// Selects the mode with the wanted size and rate and with a pixel format that this package reads: for depth
/// millimetres or, if there is no such mode, tenths of a millimetre; for color RGB888. The format is checked, because a
/// recording may have a format of one sensor in the other sensor's stream.
/// @param sensor name of the sensor, for the message
/// @throw DeviceError if there is none; its message begins with `sensor` and lists the modes that can be requested.
const openni::VideoMode& supportedVideoMode(const std::string& sensor, openni::SensorType type,
                                            const std::vector<openni::VideoMode>& modes, const FrameMode& wanted);

}  // namespace grasp_affordances
