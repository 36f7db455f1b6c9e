#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <string>

namespace grasp_affordances
{

/// The parameters of a simulated camera. Each member is a private parameter of the same name.
struct SimulatedCameraParameters
{
  std::string scene = "table";       ///< name of a scene, see sceneLibrary()
  std::string background = "walls";  ///< what is behind the things of the scene, see Background
  std::string sensor = "xtion";      ///< name or file of a depth camera, see sensorModelFromNameOrFile()
  std::uint64_t seed = 1;            ///< seed of the scene
  std::uint64_t noise_seed = 0;      ///< frame n, from 0, has noise of the seed `seed + noise_seed + n`
  double turn_deg = 0.0;             ///< degrees, -180 to 180, see viewFromAside()
  double rate = 30.0;                ///< Hz, 0.1 to 120, rate of the frames
  std::string motion = "still";      ///< still or orbit
  double amplitude_deg = 5.0;        ///< degrees, 0 to 45, see CameraOrbit
  double period_s = 10.0;            ///< s, 1 to 3600, duration of one orbit
  std::uint32_t frames_ahead = 0;    ///< 0 to 1000; this many frames are rendered at the start and then repeated; an
                                     ///< orbit then takes frames_ahead / rate; 0: each frame is rendered when it is due
  std::string world_frame = "world";  ///< name of the scene's frame
  std::string camera = "camera";      ///< prefix of the names of the camera's frames
};

/// Reads the parameters. An unknown name is an error, because the private namespace belongs to the node alone.
/// @throw ParameterError, with name, value and allowed values, for an unknown name, a wrong type (see ParameterReader)
/// or a value that is not allowed.
SimulatedCameraParameters simulatedCameraParameters(const XmlRpc::XmlRpcValue& parameters);

/// As above, read from the parameter server.
SimulatedCameraParameters simulatedCameraParameters(const ros::NodeHandle& private_node_handle);

}  // namespace grasp_affordances
