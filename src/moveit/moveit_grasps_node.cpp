#include "grasp_affordances/HandleArray.h"
#include "grasp_affordances/config.h"
#include "moveit/grasp_conversion.h"
#include "moveit/grasp_parameters.h"
#include "nodelets/parameters/parameter_reader.h"

#include <moveit_msgs/GraspPlanning.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// Answers plan_grasps (moveit_msgs/GraspPlanning), which MoveGroupInterface::planGraspsAndPick() calls, with a grasp
/// for each hand pose of the newest handles, the best first. What the request says of the object is not looked at:
/// handles are those in the localizer's workspace.
///
/// Subscribed: handles (HandleArray), selected (Handle), of the localizer. Parameters: see GraspPlannerParameters.
class GraspPlanner
{
public:
  GraspPlanner(ros::NodeHandle& nh, const GraspPlannerParameters& parameters) : parameters_(parameters)
  {
    handles_subscriber_ = nh.subscribe<HandleArray>(
        "handles", 1, [this](const HandleArrayConstPtr& message) { handles_ = message->handles; });
    selected_subscriber_ =
        nh.subscribe<Handle>("selected", 1, [this](const HandleConstPtr& message) { selected_ = *message; });
    service_ = nh.advertiseService("plan_grasps", &GraspPlanner::plan, this);
  }

private:
  using Planning = moveit_msgs::GraspPlanning;

  bool plan(Planning::Request& /*request*/, Planning::Response& response)
  {
    std::vector<Handle> handles = handles_;
    if (parameters_.only_selected) {
      handles.clear();
      if (selected_.id != 0) {
        handles.push_back(selected_);
      }
    }
    for (const Handle& handle : handles) {
      const std::vector<moveit_msgs::Grasp> grasps = graspsOf(handle, parameters_.grasp);
      response.grasps.insert(response.grasps.end(), grasps.begin(), grasps.end());
    }
    std::stable_sort(response.grasps.begin(), response.grasps.end(),
                     [](const auto& a, const auto& b) { return a.grasp_quality > b.grasp_quality; });
    response.error_code.val = moveit_msgs::MoveItErrorCodes::SUCCESS;
    if (response.grasps.empty()) {
      response.error_code.val = moveit_msgs::MoveItErrorCodes::FAILURE;
      ROS_WARN_STREAM("no grasps: " << whyNone(handles.size()));
    }
    return true;
  }

  std::string whyNone(std::size_t handles) const
  {
    if (handles > 0) {
      return "no handle has a hand pose that the gripper opens far enough for";
    }
    return parameters_.only_selected ? "no handle is selected" : "no handle is known";
  }

  // Callbacks and calls come one at a time: ros::spin() has one thread.
  const GraspPlannerParameters parameters_;
  std::vector<Handle> handles_;
  Handle selected_;  // id 0: none
  ros::Subscriber handles_subscriber_;
  ros::Subscriber selected_subscriber_;
  ros::ServiceServer service_;
};

}  // namespace
}  // namespace grasp_affordances

int main(int argc, char** argv)
{
  using namespace grasp_affordances;
  ros::init(argc, argv, "moveit_grasps");
  ros::NodeHandle nh, private_nh("~");
  try {
    const GraspPlanner planner(nh, graspPlannerParameters(ParameterReader(private_nh)));
    ros::spin();
  } catch (const ParameterError& error) {
    ROS_FATAL_STREAM(ros::this_node::getName() << " does not start: " << error.what());
    return 1;
  }
  return 0;
}
