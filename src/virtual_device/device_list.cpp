#include "virtual_device/device_list.h"

#include "simulation/scene_library.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr std::uint64_t kMostFrames = 1000;

VirtualDeviceState deviceState(const std::string& word)
{
  using State = VirtualDeviceState;
  static constexpr std::pair<const char*, State> states[] = {
      {"plugged", State::plugged},     {"unplugged", State::unplugged}, {"stalled", State::stalled},
      {"corrupt", State::corrupt},     {"misshapen", State::misshapen}, {"garbled", State::garbled},
      {"backwards", State::backwards}, {"vanishing", State::vanishing}};
  std::string words;
  for (const auto& [known, state] : states) {
    if (word == known)
      return state;
    words += std::string(words.empty() ? "" : ", ") + known;
  }
  throw std::invalid_argument("state is '" + word + "'; it must be one of " + words);
}

void checkScene(const std::string& name)
{
  const auto& library = sceneLibrary();
  if (std::none_of(library.begin(), library.end(), [&](const NamedScene& scene) { return scene.name == name; }))
    throw std::invalid_argument("there is no scene '" + name + "'");
}

/// yaml-cpp up to 0.6 takes -1 for the largest number.
std::uint64_t wholeNumber(const YAML::Node& node)
{
  if (node.IsScalar() && node.Scalar().find('-') != std::string::npos)
    throw YAML::TypedBadConversion<std::uint64_t>(node.Mark());
  return node.as<std::uint64_t>();
}

VirtualDeviceSettings parseDevice(const YAML::Node& node)
{
  VirtualDeviceSettings device;
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (key == "uri")
      device.uri = entry.second.as<std::string>();
    else if (key == "serial")
      device.serial = entry.second.as<std::string>();
    else if (key == "scene")
      device.scene.scene = entry.second.as<std::string>();
    else if (key == "sensor")
      device.scene.sensor = entry.second.as<std::string>();
    else if (key == "seed")
      device.scene.seed = wholeNumber(entry.second);
    else if (key == "noise_seed")
      device.scene.noise_seed = wholeNumber(entry.second);
    else if (key == "turn_deg")
      device.scene.turn_deg = entry.second.as<double>();
    else if (key == "frames")
      device.scene.frames = wholeNumber(entry.second);
    else if (key == "state")
      device.state = deviceState(entry.second.as<std::string>());
    else
      throw std::invalid_argument("unknown key '" + key + "'");
  }
  if (device.uri.empty())
    throw std::invalid_argument("a device has no uri");
  if (device.serial.empty())
    device.serial = device.uri;
  if (device.scene.frames < 1 || device.scene.frames > kMostFrames)
    throw std::invalid_argument("frames must be in 1 to " + std::to_string(kMostFrames));
  checkScene(device.scene.scene);
  if (device.scene.sensor != "xtion" && device.scene.sensor != "kinect_v1")
    throw std::invalid_argument("sensor is '" + device.scene.sensor + "'; it must be xtion or kinect_v1");
  return device;
}

}  // namespace

bool operator==(const VirtualScene& a, const VirtualScene& b)
{
  const auto members = [](const VirtualScene& s) {
    return std::tie(s.scene, s.sensor, s.seed, s.noise_seed, s.turn_deg, s.frames);
  };
  return members(a) == members(b);
}

std::vector<VirtualDeviceSettings> parseDeviceList(const std::string& yaml)
{
  std::vector<VirtualDeviceSettings> devices;
  try {
    const YAML::Node list = YAML::Load(yaml);
    if (!list.IsSequence())
      throw std::invalid_argument("not a list of devices");
    for (const YAML::Node& node : list) {
      const VirtualDeviceSettings device = parseDevice(node);
      if (std::any_of(devices.begin(), devices.end(), [&](const auto& other) { return other.uri == device.uri; }))
        throw std::invalid_argument("the uri '" + device.uri + "' comes twice");
      devices.push_back(device);
    }
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(error.what());
  }
  return devices;
}

}  // namespace grasp_affordances
