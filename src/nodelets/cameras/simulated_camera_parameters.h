#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <string>

namespace grasp_affordances
{

/// Everything that a simulated camera is told by private parameters of these names.
struct SimulatedCameraParameters
{
  std::string scene = "table";        ///< a name in sceneLibrary()
  std::uint64_t seed = 1;             ///< of the scene
  std::uint64_t noise_seed = 0;       ///< the noise of frame n, from 0, has the seed seed + noise_seed + n
  double turn_deg = 0.0;              ///< degrees, -180 to 180, see viewFromAside()
  double rate = 30.0;                 ///< Hz, 0.1 to 120, of the frames
  std::string motion = "still";       ///< still or orbit
  double amplitude_deg = 5.0;         ///< degrees, 0 to 45, see CameraOrbit
  double period_s = 10.0;             ///< s, 1 to 3600, of one orbit
  std::uint32_t frames_ahead = 0;     ///< 0 to 1000, rendered ahead of time, then published in turn for ever: an orbit
                                      ///< then takes frames_ahead / rate; 0: each is rendered when it is due
  std::string world_frame = "world";  ///< the scene's frame
  std::string camera = "camera";      ///< what the names of the camera's frames begin with
};

/// Every name must be known: the private namespace belongs to the node.
/// @throw ParameterError with name, value and allowed values for an unknown name, a wrong type (see ParameterReader) or
/// a value that is not allowed.
SimulatedCameraParameters simulatedCameraParameters(const XmlRpc::XmlRpcValue& parameters);

/// As above, from the parameter server.
SimulatedCameraParameters simulatedCameraParameters(const ros::NodeHandle& private_node_handle);

}  // namespace grasp_affordances
