#include "grasp_affordances/point_cloud2.h"
#include "io/pcd.h"

#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

namespace
{

/// @throw grasp_affordances::CloudError for a file that cannot be read.
sensor_msgs::PointCloud2 messageFromPcd(const std::string& file)
{
  pcl::PCLPointCloud2 cloud = grasp_affordances::readPcd(file);
  sensor_msgs::PointCloud2 message;
  pcl_conversions::moveFromPCL(cloud, message);
  return message;
}

void publishRepeatedly(ros::Publisher& publisher, sensor_msgs::PointCloud2& message, double rate)
{
  ros::Rate pause(rate);
  while (ros::ok()) {
    message.header.stamp = ros::Time::now();
    publisher.publish(message);
    ros::spinOnce();
    pause.sleep();
  }
}

}  // namespace

/// Publishes a PCD file on `points`, stamped with the time of publication.
/// Parameters: ~file; ~frame_id (camera_depth_optical_frame); ~rate in Hz (10), 0: once, latched.
int main(int argc, char** argv)
{
  ros::init(argc, argv, "pcd_publisher");
  ros::NodeHandle nh;
  ros::NodeHandle private_nh("~");
  const std::string file = private_nh.param("file", std::string());
  const double rate = private_nh.param("rate", 10.0);
  if (file.empty() || !(rate >= 0.0)) {
    ROS_FATAL("parameter ~file ('%s') must name a PCD file, and ~rate (%g) be at least 0 Hz", file.c_str(), rate);
    return 1;
  }

  sensor_msgs::PointCloud2 message;
  try {
    message = messageFromPcd(file);
  } catch (const grasp_affordances::CloudError& error) {
    ROS_FATAL("%s: %s", file.c_str(), error.what());
    return 1;
  }
  message.header.frame_id = private_nh.param("frame_id", std::string("camera_depth_optical_frame"));

  const bool once = rate == 0.0;
  ros::Publisher publisher = nh.advertise<sensor_msgs::PointCloud2>("points", 1, once);
  if (once) {
    message.header.stamp = ros::Time::now();
    publisher.publish(message);
    ros::spin();
  } else {
    publishRepeatedly(publisher, message, rate);
  }
  return 0;
}
