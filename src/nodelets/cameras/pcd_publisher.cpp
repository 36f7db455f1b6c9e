#include "grasp_affordances/point_cloud2.h"
#include "io/pcd.h"
#include "nodelets/parameters/parameter_reader.h"

#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

#include <exception>
#include <sstream>
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

void publishRepeatedly(const ros::Publisher& publisher, sensor_msgs::PointCloud2& message, double rate)
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

/// Publishes the cloud of a PCD file on the topic `points`. Its stamp is the time of publication.
/// Parameters: ~file, the path; ~frame_id, default camera_depth_optical_frame; ~rate in Hz, default 10. With a rate of
/// 0 every new subscriber gets the cloud once.
int main(int argc, char** argv)
{
  ros::init(argc, argv, "pcd_publisher");
  ros::NodeHandle nh;
  ros::NodeHandle private_nh("~");
  constexpr double kSlowest = 0.001;  // Hz
  std::string file, frame_id = "camera_depth_optical_frame";
  double rate = 10.0;
  sensor_msgs::PointCloud2 message;
  try {
    grasp_affordances::ParameterReader read(private_nh);
    read("file", file, "the path of a PCD file");
    read("frame_id", frame_id, "the name of a frame");
    read("rate", rate, grasp_affordances::Range<double>{0.0, 1000.0}, "Hz", "");
    read.refuseRemaining();
    if (rate > 0.0 && rate < kSlowest) {
      std::ostringstream refusal;
      refusal << "parameter ~rate is " << rate << "; it must be 0 (once) or a number in [" << kSlowest << ", 1000] Hz";
      throw grasp_affordances::ParameterError(refusal.str());
    }
    message = messageFromPcd(file);
  } catch (const grasp_affordances::ParameterError& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  } catch (const std::exception& error) {  // CloudError, or not enough memory for the file
    ROS_FATAL("%s: %s", file.c_str(), error.what());
    return 1;
  }
  message.header.frame_id = frame_id;

  if (rate == 0.0) {
    // Not latched: roscpp does not send the latched message to a subscriber that connects while it is published.
    message.header.stamp = ros::Time::now();
    const auto greet = [&message](const ros::SingleSubscriberPublisher& subscriber) { subscriber.publish(message); };
    const ros::Publisher publisher = nh.advertise<sensor_msgs::PointCloud2>("points", 1, greet);
    ros::spin();
  } else {
    publishRepeatedly(nh.advertise<sensor_msgs::PointCloud2>("points", 1), message, rate);
  }
  return 0;
}
