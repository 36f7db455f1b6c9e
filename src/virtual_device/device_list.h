#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// State of a virtual device: how it behaves.
enum class VirtualDeviceState
{
  plugged,
  unplugged,
  stalled,    ///< plugged in, but sends no frames
  corrupt,    ///< plugged in, but sends incomplete frames, as after data loss on USB
  misshapen,  ///< plugged in, but its frames state wrong sizes: zero, negative or huge
  garbled,    ///< plugged in, but half of each depth image is wrong, after rows of impossible depths
  backwards,  ///< plugged in, but its clock jumps back and forth, and stands still
  vanishing   ///< unplugged during its fifth frame and plugged in again at once, repeatedly
};

/// The scene that a virtual device sees.
struct VirtualScene
{
  std::string scene = "table";   ///< a name in sceneLibrary()
  std::string sensor = "xtion";  ///< xtion or kinect_v1: those that OpenNI2 knows
  std::uint64_t seed = 1;        ///< of the scene
  std::uint64_t noise_seed = 0;  ///< rendered frame n, from 0, has noise of the seed `seed + noise_seed + n`
  double turn_deg = 0.0;         ///< degrees, see viewFromAside()
  std::uint64_t frames = 8;      ///< 1 to 1000; number of frames that are rendered at the start and then repeated
};

bool operator==(const VirtualScene& a, const VirtualScene& b);

/// One entry of the list of virtual devices. The list is a YAML sequence of maps; their keys are the members of this
/// struct and of VirtualScene. Only `uri` is required.
struct VirtualDeviceSettings
{
  std::string uri;
  std::string serial;  ///< default: the URI
  VirtualDeviceState state = VirtualDeviceState::plugged;
  VirtualScene scene;
};

/// @throw std::invalid_argument if the text is not such a list, for an unknown key, scene, sensor or state, and for a
/// repeated URI.
std::vector<VirtualDeviceSettings> parseDeviceList(const std::string& yaml);

}  // namespace grasp_affordances
