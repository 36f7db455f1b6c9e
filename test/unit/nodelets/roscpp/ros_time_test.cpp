#include "nodelets/roscpp/ros_time.h"

#include <gtest/gtest.h>

#include <chrono>

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

constexpr std::chrono::steady_clock::time_point kStart{std::chrono::hours(1)};

Moment after(double steady_s, double simulated_s)
{
  return {kStart + std::chrono::milliseconds(static_cast<int>(1e3 * steady_s)), ros::Time(simulated_s)};
}

TEST(SecondsBetween, AreThoseOfASimulation)
{
  EXPECT_DOUBLE_EQ(secondsBetween(after(0.0, 100.0), after(60.0, 100.0)), 0.0) << "it is paused";
  EXPECT_DOUBLE_EQ(secondsBetween(after(0.0, 100.0), after(1.0, 110.0)), 10.0) << "it is faster";
}

TEST(SecondsBetween, AreThoseOfTheSteadyClockWhereNoOtherTells)
{
  EXPECT_DOUBLE_EQ(secondsBetween(after(0.0, 0.0), after(2.0, 0.0)), 2.0) << "not simulated, or no /clock";
  EXPECT_DOUBLE_EQ(secondsBetween(after(0.0, 0.0), after(2.0, 100.0)), 2.0) << "the first /clock came in between";
  EXPECT_DOUBLE_EQ(secondsBetween(after(0.0, 100.0), after(2.0, 50.0)), 2.0) << "it began anew";
}

}  // namespace
}  // namespace grasp_affordances
