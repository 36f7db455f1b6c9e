#include "nodelets/cameras/camera_messages.h"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace grasp_affordances
{
namespace
{

sensor_msgs::ImagePtr depthMessage(const Frame& frame, const std_msgs::Header& header)
{
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->width = frame.cloud.width;
  message->height = frame.cloud.height;
  message->encoding = sensor_msgs::image_encodings::TYPE_16UC1;
  message->step = message->width * sizeof(std::uint16_t);
  message->data.resize(frame.depth.size() * sizeof(std::uint16_t));
  std::memcpy(message->data.data(), frame.depth.data(), message->data.size());
  return message;
}

sensor_msgs::PointCloud2Ptr pointsMessage(const Cloud& cloud, const std_msgs::Header& header)
{
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header = header;
  message->width = cloud.width;
  message->height = cloud.height;
  message->is_dense = false;
  sensor_msgs::PointCloud2Modifier(*message).setPointCloud2FieldsByString(1, "xyz");
  sensor_msgs::PointCloud2Iterator<float> xyz(*message, "x");
  for (std::size_t i = 0; i < cloud.size(); ++i, ++xyz) {
    xyz[0] = cloud.x[i];
    xyz[1] = cloud.y[i];
    xyz[2] = cloud.z[i];
  }
  return message;
}

template <typename Message>
void restampOrReplace(boost::shared_ptr<Message>& message, const ros::Time& stamp)
{
  if (message.use_count() > 1) {
    message = boost::make_shared<Message>(*message);
  }
  message->header.stamp = stamp;
}

}  // namespace

sensor_msgs::CameraInfoPtr cameraInfoMessage(const PinholeIntrinsics& camera, std::uint32_t width, std::uint32_t height,
                                             const std_msgs::Header& header)
{
  auto message = boost::make_shared<sensor_msgs::CameraInfo>();
  message->header = header;
  message->width = width;
  message->height = height;
  message->distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  message->D.assign(5, 0.0);
  message->K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message->R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message->P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

FrameMessages frameMessages(const Frame& frame, const SensorModel& model, const std_msgs::Header& header)
{
  return {cameraInfoMessage(model.intrinsics, model.width, model.height, header), depthMessage(frame, header),
          pointsMessage(frame.cloud, header)};
}

void restamp(FrameMessages& messages, const ros::Time& stamp)
{
  restampOrReplace(messages.camera_info, stamp);
  restampOrReplace(messages.depth, stamp);
  restampOrReplace(messages.points, stamp);
}

}  // namespace grasp_affordances
