#include "nodelets/cameras/simulated_camera_parameters.h"

#include "nodelets/parameters/parameter_reader.h"
#include "simulation/background.h"
#include "simulation/scene_library.h"

#include <algorithm>
#include <vector>

namespace grasp_affordances
{
namespace
{

void readWord(ParameterReader& read, const std::string& name, std::string& word,
              const std::vector<std::string>& allowed_words)
{
  std::string allowed = "one of";
  for (const std::string& candidate : allowed_words) {
    allowed += " " + candidate;
  }
  read(name, word, allowed);
  if (std::find(allowed_words.begin(), allowed_words.end(), word) == allowed_words.end()) {
    throw ParameterError("parameter ~" + name + " is the string '" + word + "'; it must be " + allowed);
  }
}

std::vector<std::string> sceneNames()
{
  std::vector<std::string> names;
  for (const NamedScene& scene : sceneLibrary()) {
    names.push_back(scene.name);
  }
  return names;
}

SimulatedCameraParameters simulatedCameraParameters(ParameterReader read)
{
  using Real = Range<double>;
  SimulatedCameraParameters result;
  readWord(read, "scene", result.scene, sceneNames());
  readWord(read, "background", result.background, backgroundNames());
  read("sensor", result.sensor, "the name of a sensor or of a file of one");
  const Range<std::uint64_t> seeds{0, (std::uint64_t{1} << 53) - 1};
  read("seed", result.seed, seeds, "", "");
  read("noise_seed", result.noise_seed, seeds, "", "");
  read("turn_deg", result.turn_deg, Real{-180.0, 180.0}, "degrees", "");
  read("rate", result.rate, Real{0.1, 120.0}, "Hz", "");
  readWord(read, "motion", result.motion, {"still", "orbit"});
  read("amplitude_deg", result.amplitude_deg, Real{0.0, 45.0}, "degrees", "");
  read("period_s", result.period_s, Real{1.0, 3600.0}, "s", "");
  read("frames_ahead", result.frames_ahead, Range<std::uint32_t>{0, 1000}, "", "");
  read("world_frame", result.world_frame, "the name of a frame");
  read("camera", result.camera, "what the names of frames begin with");
  read.refuseRemaining();
  return result;
}

}  // namespace

SimulatedCameraParameters simulatedCameraParameters(const XmlRpc::XmlRpcValue& parameters)
{
  return simulatedCameraParameters(ParameterReader(parameters));
}

SimulatedCameraParameters simulatedCameraParameters(const ros::NodeHandle& private_node_handle)
{
  return simulatedCameraParameters(ParameterReader(private_node_handle));
}

}  // namespace grasp_affordances
