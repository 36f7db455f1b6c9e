#include "nodelets/parameters_ros.h"

#include "grasp_affordances/parameters.h"
#include "nodelets/parameter_reader.h"

#include <string>

namespace grasp_affordances
{
namespace
{

NodeParameters nodeParameters(ParameterReader read)
{
  NodeParameters result;
  std::string preset = result.config.preset;
  read("preset", preset, "the name of a preset");
  result.config = presetConfig(preset);
  visitParameters(result.config, read);
  read("lazy", result.lazy, "");
  read("workspace_frame", result.workspace_frame, "the name of a frame");
  read("target_frame", result.target_frame, "the name of a frame");
  read("transform_timeout", result.transform_timeout, Range<double>{0.0, 10.0}, "s", "");
  read.refuseRemaining();
  validate(result.config);
  return result;
}

}  // namespace

NodeParameters nodeParameters(const XmlRpc::XmlRpcValue& parameters)
{
  return nodeParameters(ParameterReader(parameters));
}

NodeParameters nodeParameters(const ros::NodeHandle& private_node_handle)
{
  return nodeParameters(ParameterReader(private_node_handle));
}

}  // namespace grasp_affordances
