#include "nodelets/roscpp/ros_time.h"

#include <gtest/gtest.h>

namespace grasp_affordances
{
namespace
{

TEST(TimeJumps, NoticesEveryStampThatIsEarlierThanTheOneBefore)
{
  TimeJumps jumps;
  EXPECT_FALSE(jumps.wentBack(ros::Time(100.0))) << "the first";
  EXPECT_FALSE(jumps.wentBack(ros::Time(100.0))) << "the same again";
  EXPECT_FALSE(jumps.wentBack(ros::Time(200.0)));
  EXPECT_TRUE(jumps.wentBack(ros::Time(199.9)));
  EXPECT_FALSE(jumps.wentBack(ros::Time(199.95))) << "it goes on from there";
  EXPECT_TRUE(jumps.wentBack(ros::Time(1.0)));
}

TEST(TimeJumps, AMissingStampSaysNothing)
{
  TimeJumps jumps;
  EXPECT_FALSE(jumps.wentBack(ros::Time(100.0)));
  EXPECT_FALSE(jumps.wentBack(ros::Time()));
  EXPECT_TRUE(jumps.wentBack(ros::Time(99.0)));
}

TEST(TimeJumps, WhatIsOutOfOrderByLessThanTheToleranceIsNoJump)
{
  TimeJumps jumps(ros::Duration(0.5));
  EXPECT_FALSE(jumps.wentBack(ros::Time(100.0)));
  EXPECT_FALSE(jumps.wentBack(ros::Time(99.6)));
  EXPECT_FALSE(jumps.wentBack(ros::Time(99.5)));
  EXPECT_TRUE(jumps.wentBack(ros::Time(99.4))) << "little by little it adds up";
  EXPECT_FALSE(jumps.wentBack(ros::Time(99.0))) << "it goes on from there";
  EXPECT_TRUE(jumps.wentBack(ros::Time(1.0)));
}

}  // namespace
}  // namespace grasp_affordances
