#include "nodelets/parameters/parameters_ros.h"

#include "grasp_affordances/parameters.h"
#include "nodelets/parameters/parameter_reader.h"
#include "nodelets/parameters/reconfiguration.h"
#include "nodelets/roscpp/cloud_synchronizer.h"
#include "nodelets/roscpp/frame_name.h"

#include <algorithm>
#include <string>

namespace grasp_affordances
{
namespace
{

void readFrame(const std::string& name, ParameterReader& read, std::string& frame)
{
  read(name, frame, "the name of a frame");
  frame = frameName(frame);
}

void readNodeParameters(ParameterReader& read, NodeParameters& result)
{
  std::string preset = result.config.preset;
  read("preset", preset, "the name of a preset");
  result.config = presetConfig(preset);
  visitParameters(result.config, read);
  read("lazy", result.lazy, "");
  read("on_demand", result.on_demand, "");
  read("max_rate", result.max_rate, Range<double>{0.0, 120.0}, "Hz", "");
  read("max_age", result.max_age, Range<double>{0.0, 3600.0}, "s", "");
  readFrame("workspace_frame", read, result.workspace_frame);
  readFrame("target_frame", read, result.target_frame);
  readFrame("fixed_frame", read, result.fixed_frame);
  readFrame("approach_frame", read, result.approach_frame);
  read("transform_timeout", result.transform_timeout, Range<double>{0.0, 10.0}, "s", "");
  read.passOver(Reconfiguration::kNamespace);
}

NodeParameters nodeParameters(ParameterReader read)
{
  NodeParameters result;
  readNodeParameters(read, result);
  readFrame("sensor_frame", read, result.sensor_frame);
  read.refuseRemaining();
  validate(result.config);
  return result;
}

MultiCameraParameters multiCameraParameters(ParameterReader read)
{
  MultiCameraParameters result;
  readNodeParameters(read, result.node);
  read("views", result.views, Range<std::uint32_t>{2, CloudSynchronizer::kMostViews}, "", "");
  read("sync_slop", result.sync_slop, Range<double>{0.0, 10.0}, "s", "");
  read.refuseRemaining();
  validate(result.node.config);
  if (result.node.target_frame.empty()) {
    throw ParameterError(
        "parameter ~target_frame is not given; it must be the name of the frame that the clouds are brought into");
  }
  return result;
}

}  // namespace

double longestAge(const NodeParameters& parameters)
{
  if (parameters.on_demand) {
    return 0.0;  // the cloud was asked for, and whoever did knows when
  }
  if (parameters.max_age == 0.0 || parameters.max_rate == 0.0) {
    return parameters.max_age;
  }
  return std::max(parameters.max_age, 2.0 / parameters.max_rate);
}

NodeParameters nodeParameters(const XmlRpc::XmlRpcValue& parameters)
{
  return nodeParameters(ParameterReader(parameters));
}

NodeParameters nodeParameters(const ros::NodeHandle& private_node_handle)
{
  return nodeParameters(ParameterReader(private_node_handle));
}

MultiCameraParameters multiCameraParameters(const XmlRpc::XmlRpcValue& parameters)
{
  return multiCameraParameters(ParameterReader(parameters));
}

MultiCameraParameters multiCameraParameters(const ros::NodeHandle& private_node_handle)
{
  return multiCameraParameters(ParameterReader(private_node_handle));
}

}  // namespace grasp_affordances
