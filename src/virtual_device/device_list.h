#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What happens to a virtual device.
enum class VirtualDeviceState
{
  plugged,
  unplugged,
  stalled,    ///< plugged, but sends no frames
  corrupt,    ///< plugged, but sends incomplete frames, as after losses on the USB
  misshapen,  ///< plugged, but its frames say sizes that are not those of their mode: none, negative, huge ones
  garbled,    ///< plugged, but half of each depth image is of another frame, with depths that are none in between
  backwards,  ///< plugged, but its clock jumps back and forth, and stands still
  vanishing   ///< pulled out in the middle of its fifth frame, and plugged in again at once; and so on
};

/// What a virtual device shows.
struct VirtualScene
{
  std::string scene = "table";   ///< a name in sceneLibrary()
  std::uint64_t seed = 1;        ///< of the scene
  std::uint64_t noise_seed = 0;  ///< content n, from 0, has the noise of the seed seed + noise_seed + n
  double turn_deg = 0.0;         ///< degrees, see viewFromAside()
  std::uint64_t frames = 8;      ///< 1 to 1000; rendered ahead of time, then sent in turn for ever
};

bool operator==(const VirtualScene& a, const VirtualScene& b);

/// One entry of the list of virtual devices: a YAML sequence of maps with these keys and those of VirtualScene, of
/// which only `uri` is required.
struct VirtualDeviceSettings
{
  std::string uri;
  std::string serial;  ///< default: the URI
  VirtualDeviceState state = VirtualDeviceState::plugged;
  VirtualScene scene;
};

/// @throw std::invalid_argument for what is no such list, an unknown key, scene or state, and a URI that comes twice.
std::vector<VirtualDeviceSettings> parseDeviceList(const std::string& yaml);

}  // namespace grasp_affordances
