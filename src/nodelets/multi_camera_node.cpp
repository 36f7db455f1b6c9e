#include <nodelet/loader.h>
#include <ros/ros.h>

/// The MultiCameraNodelet in a process of its own.
int main(int argc, char** argv)
{
  ros::init(argc, argv, "multi_camera");
  const bool provide_ros_api = false;
  nodelet::Loader loader(provide_ros_api);
  if (!loader.load(ros::this_node::getName(), "grasp_affordances/MultiCameraNodelet", ros::names::getRemappings(),
                   {})) {
    return 1;
  }
  ros::spin();
  return 0;
}
