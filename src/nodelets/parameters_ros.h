#pragma once

#include "grasp_affordances/config.h"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

namespace grasp_affordances
{

/// Everything that a localizer node is told by private parameters.
struct NodeParameters
{
  Config config;
  bool lazy = true;  ///< subscribe only while somebody listens to an output
};

/// Reads the struct of a node's private parameters: `preset` names the base, `lazy` and the parameters of
/// visitParameters() overrule it. Every name must be known: the private namespace belongs to the node.
/// @throw ParameterError with name, value and allowed values for an unknown name, a wrong type (see ParameterReader) or a
/// value outside its range.
NodeParameters nodeParameters(const XmlRpc::XmlRpcValue& parameters);

/// As above, from the parameter server.
NodeParameters nodeParameters(const ros::NodeHandle& private_node_handle);

}  // namespace grasp_affordances
