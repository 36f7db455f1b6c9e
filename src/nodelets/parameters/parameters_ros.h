#pragma once

#include "grasp_affordances/config.h"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <string>

namespace grasp_affordances
{

/// Everything that a localizer node is told by private parameters.
struct NodeParameters
{
  Config config;
  bool lazy = true;                ///< subscribe only while somebody listens to an output
  bool on_demand = false;          ///< localize only in clouds that are asked for, see TriggerService
  double max_rate = 0.0;           ///< Hz, of clouds that are localized in unasked; 0: as fast as they come
  double max_age = 5.0;            ///< s since the newest cloud arrived beyond which ~best and ~select refuse; 0: never
  std::string workspace_frame;     ///< of the box in `config`; empty: the frame of the cloud
  std::string target_frame;        ///< of the outputs; empty: the frame of the cloud
  std::string fixed_frame;         ///< in which handles stand still and are tracked; empty: that of the outputs
  std::string approach_frame;      ///< of the direction of approach in `config`; empty: the frame of the cloud
  std::string sensor_frame;        ///< its origin is the place of the sensor, for clouds that are no range images;
                                   ///< empty: not known. Only for one camera
  double transform_timeout = 0.1;  ///< s of wall-clock time that a cloud waits for its transforms
};

/// s since the newest cloud arrived beyond which its handles are refused: `max_age` or, where `max_rate` asks for
/// longer pauses, two of these; 0: never, as where clouds are localized in on demand.
double longestAge(const NodeParameters& parameters);

/// Reads the struct of a node's private parameters: `preset` names the base, the parameters of
/// visitParameters() and those above overrule it. Every name must be known: the private namespace belongs to the node.
/// Only what Reconfiguration has left there is passed over.
/// @throw ParameterError with name, value and allowed values for an unknown name, a wrong type (see ParameterReader) or
/// a value outside its range.
NodeParameters nodeParameters(const XmlRpc::XmlRpcValue& parameters);

/// As above, from the parameter server.
NodeParameters nodeParameters(const ros::NodeHandle& private_node_handle);

/// Everything that a node with several cameras is told.
struct MultiCameraParameters
{
  NodeParameters node;       ///< `target_frame` is the frame that the clouds are brought into: it must be given, and is
                             ///< that of the box and of the direction in `config`, too, where no other is
  std::uint32_t views = 2;   ///< cameras
  double sync_slop = 0.035;  ///< s by which the stamps of the clouds of one moment may differ
};

/// As nodeParameters().
MultiCameraParameters multiCameraParameters(const XmlRpc::XmlRpcValue& parameters);
MultiCameraParameters multiCameraParameters(const ros::NodeHandle& private_node_handle);

}  // namespace grasp_affordances
