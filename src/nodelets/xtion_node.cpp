#include <nodelet/loader.h>
#include <ros/ros.h>

/// The XtionNodelet in a process of its own.
int main(int argc, char** argv)
{
  ros::init(argc, argv, "xtion");
  const bool provide_ros_api = false;
  nodelet::Loader loader(provide_ros_api);
  if (!loader.load(ros::this_node::getName(), "grasp_affordances/XtionNodelet", ros::names::getRemappings(), {})) {
    return 1;
  }
  ros::spin();
  return 0;
}
