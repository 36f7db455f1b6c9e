#include "nodelets/localizer/cloud_pace.h"

#include <gtest/gtest.h>

namespace grasp_affordances
{
namespace
{

/// Clouds that arrive at times of their own, in s since somebody listens.
class CloudPaceTest : public testing::Test
{
protected:
  CloudPaceTest() { pace_.begin(at(0.0)); }

  static CloudPace::Time at(double seconds)
  {
    const CloudPace::Time begin{std::chrono::hours(1)};
    return begin +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  }

  CloudPace pace_;
};

TEST_F(CloudPaceTest, TheFirstCloudIsOverdueAfterFiveSeconds)
{
  EXPECT_FALSE(pace_.isOverdue(at(4.9)));
  EXPECT_TRUE(pace_.isOverdue(at(5.0)));
  EXPECT_EQ(pace_.arrivals(), 0U);
}

TEST_F(CloudPaceTest, CloudsThatCeaseAreOverdueAfterFiveSeconds)
{
  for (int i = 0; i < 300; ++i) {
    pace_.arrive(at(i / 30.0));
  }
  EXPECT_FALSE(pace_.isOverdue(at(14.9)));
  EXPECT_TRUE(pace_.isOverdue(at(15.0)));
  EXPECT_NEAR(pace_.waited(at(15.0)), 15.0 - 299.0 / 30.0, 1e-9);
}

TEST_F(CloudPaceTest, SlowCloudsAreOverdueAfterThreeTimesTheirLongestInterval)
{
  for (const double time : {0.0, 10.0, 18.0, 28.0}) {
    pace_.arrive(at(time));
  }
  EXPECT_FALSE(pace_.isOverdue(at(57.9)));
  EXPECT_TRUE(pace_.isOverdue(at(58.0)));
}

TEST_F(CloudPaceTest, APauseIsForgottenAfterTenClouds)
{
  pace_.arrive(at(0.0));
  for (int i = 0; i < 10; ++i) {
    pace_.arrive(at(60.0 + i));
  }
  EXPECT_FALSE(pace_.isOverdue(at(69.0 + 179.0))) << "the pause is one of ten intervals";
  pace_.arrive(at(70.0));
  EXPECT_TRUE(pace_.isOverdue(at(75.0)));
}

TEST_F(CloudPaceTest, WhatIsKnownOfThePaceStaysWhenNobodyListensForAWhile)
{
  pace_.arrive(at(0.0));
  pace_.arrive(at(10.0));
  pace_.begin(at(500.0));
  EXPECT_EQ(pace_.arrivals(), 0U);
  EXPECT_FALSE(pace_.isOverdue(at(529.9)));
  EXPECT_TRUE(pace_.isOverdue(at(530.0)));
}

}  // namespace
}  // namespace grasp_affordances
