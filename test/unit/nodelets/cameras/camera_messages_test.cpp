#include "nodelets/cameras/camera_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace grasp_affordances
{
namespace
{

SensorModel tinyModel()
{
  SensorModel model;
  model.width = 2;
  model.height = 1;
  return model;
}

/// One pixel measured, the other not.
FrameMessages tinyFrame()
{
  Frame frame;
  frame.cloud.reset(2, 1);
  frame.cloud.set(0, 0.1F, 0.2F, 0.8F);
  frame.depth = {800, 0};
  std_msgs::Header header;
  header.frame_id = "optical";
  header.stamp = ros::Time(1, 0);
  return frameMessages(frame, tinyModel(), header);
}

TEST(FrameMessages, HoldTheFrameUnderOneHeader)
{
  const FrameMessages frame = tinyFrame();
  for (const std_msgs::Header& header : {frame.camera_info->header, frame.depth->header, frame.points->header}) {
    EXPECT_EQ(header.frame_id, "optical");
    EXPECT_EQ(header.stamp, ros::Time(1, 0));
  }
  EXPECT_EQ(frame.camera_info->width, 2U);
  EXPECT_EQ(frame.camera_info->P[0], tinyModel().intrinsics.fx);

  std::uint16_t depth[2];
  ASSERT_EQ(frame.depth->data.size(), sizeof(depth));
  std::memcpy(depth, frame.depth->data.data(), sizeof(depth));
  EXPECT_EQ(depth[0], 800);
  EXPECT_EQ(depth[1], 0);

  float point[3];
  std::memcpy(point, frame.points->data.data(), sizeof(point));
  EXPECT_EQ(point[0], 0.1F);
  EXPECT_EQ(point[1], 0.2F);
  EXPECT_EQ(point[2], 0.8F);
  std::memcpy(point, frame.points->data.data() + frame.points->point_step, sizeof(point));
  EXPECT_TRUE(std::isnan(point[0]) && std::isnan(point[1]) && std::isnan(point[2]));
}

TEST(Restamp, ReusesMessagesThatNobodyElseHolds)
{
  FrameMessages frame = tinyFrame();
  const sensor_msgs::PointCloud2* points = frame.points.get();
  const sensor_msgs::Image* depth = frame.depth.get();
  const sensor_msgs::CameraInfo* camera_info = frame.camera_info.get();
  restamp(frame, ros::Time(2, 0));
  EXPECT_EQ(frame.points.get(), points);
  EXPECT_EQ(frame.depth.get(), depth);
  EXPECT_EQ(frame.camera_info.get(), camera_info);
  EXPECT_EQ(frame.points->header.stamp, ros::Time(2, 0));
  EXPECT_EQ(frame.depth->header.stamp, ros::Time(2, 0));
  EXPECT_EQ(frame.camera_info->header.stamp, ros::Time(2, 0));
}

TEST(Restamp, LeavesMessagesThatSomebodyHoldsAsTheyAre)
{
  FrameMessages frame = tinyFrame();
  const sensor_msgs::PointCloud2ConstPtr points = frame.points;
  const sensor_msgs::ImageConstPtr depth = frame.depth;
  const sensor_msgs::CameraInfoConstPtr camera_info = frame.camera_info;
  restamp(frame, ros::Time(2, 0));
  EXPECT_EQ(points->header.stamp, ros::Time(1, 0));
  EXPECT_EQ(depth->header.stamp, ros::Time(1, 0));
  EXPECT_EQ(camera_info->header.stamp, ros::Time(1, 0));
  EXPECT_EQ(frame.points->header.stamp, ros::Time(2, 0));
  EXPECT_EQ(frame.depth->header.stamp, ros::Time(2, 0));
  EXPECT_EQ(frame.camera_info->header.stamp, ros::Time(2, 0));
  EXPECT_EQ(frame.points->data, points->data);
  EXPECT_EQ(frame.depth->data, depth->data);
  EXPECT_EQ(frame.camera_info->P, camera_info->P);
}

}  // namespace
}  // namespace grasp_affordances
