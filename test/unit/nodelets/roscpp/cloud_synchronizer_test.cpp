#include "nodelets/roscpp/cloud_synchronizer.h"

#include <gtest/gtest.h>
#include <ros/time.h>
#include <boost/make_shared.hpp>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kStart = 1000.0;  // s
constexpr double kPeriod = 1.0 / 30.0;
constexpr double kSlop = 0.02;

CloudSynchronizer::Points cloudAt(double time)
{
  const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header.stamp.fromSec(time);
  return cloud;
}

/// Cameras that were started 2 ms after one another.
class Cameras
{
public:
  explicit Cameras(std::size_t views)
      : views_(views), synchronizer_(views, kSlop, [this](const CloudSynchronizer::Set& set) { sets.push_back(set); })
  {
    ros::Time::init();
  }

  void deliver(double time)
  {
    for (std::size_t view = 0; view < views_; ++view) {
      add(view, time + 0.002 * static_cast<double>(view));
    }
  }

  void add(std::size_t view, double time) { synchronizer_.add(view, cloudAt(time)); }

  /// With more nanoseconds than a second has, as a message may have them.
  void addBeyond(std::size_t view, double time)
  {
    const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(*cloudAt(time));
    cloud->header.stamp.nsec = 4294967295U;
    synchronizer_.add(view, cloud);
  }

  void restart() { synchronizer_.restart(); }

  std::vector<CloudSynchronizer::Set> sets;

private:
  const std::size_t views_;
  CloudSynchronizer synchronizer_;
};

TEST(CloudSynchronizer, SetsOfAnyNumberOfCameras)
{
  for (std::size_t views = 2; views <= CloudSynchronizer::kMostViews; ++views) {
    Cameras cameras(views);
    for (int i = 0; i < 10; ++i) {
      cameras.deliver(kStart + i * kPeriod);
    }
    ASSERT_GE(cameras.sets.size(), 9U) << views;  // with the last one the next may be better
    for (std::size_t i = 0; i < cameras.sets.size(); ++i) {
      ASSERT_EQ(cameras.sets[i].size(), views);
      for (std::size_t view = 0; view < views; ++view) {
        EXPECT_NEAR(cameras.sets[i][view]->header.stamp.toSec(),
                    kStart + static_cast<double>(i) * kPeriod + 0.002 * static_cast<double>(view), 1e-6);
      }
    }
  }
}

TEST(CloudSynchronizer, DoesNotWaitWhereNothingBetterCanCome)
{
  Cameras cameras(3);
  cameras.deliver(kStart);
  EXPECT_EQ(cameras.sets.size(), 1U);
}

TEST(CloudSynchronizer, WhatIsFurtherApartIsNoSet)
{
  Cameras cameras(2);
  for (int i = 0; i < 10; ++i) {
    cameras.add(0, kStart + i);
    cameras.add(1, kStart + i + 1.2 * kSlop);
  }
  EXPECT_TRUE(cameras.sets.empty());
  for (int i = 10; i < 20; ++i) {
    cameras.add(0, kStart + i);
    cameras.add(1, kStart + i + 0.8 * kSlop);
  }
  EXPECT_GE(cameras.sets.size(), 9U);
}

TEST(CloudSynchronizer, ASilentCameraMakesNoSet)
{
  Cameras cameras(3);
  for (int i = 0; i < 100; ++i) {
    cameras.add(0, kStart + i * kPeriod);
    cameras.add(2, kStart + i * kPeriod);
  }
  EXPECT_TRUE(cameras.sets.empty());
}

/// With some of them roscpp's times cannot be computed.
TEST(CloudSynchronizer, TakesStampsOfAnyKind)
{
  const double times[] = {kStart, 0.0, 0.7e9, 1.7e9, 2147483647.0, 2147483648.5, 2.8e9, 4294967290.0, 4294967295.9};
  for (const double first : times) {
    for (const double second : times) {
      for (const double third : times) {
        Cameras cameras(2);
        for (const double time : {first, second, third, second}) {
          cameras.add(0, time);
          cameras.add(1, time + 0.019);
          cameras.addBeyond(1, time);
        }
        cameras.restart();
        const std::size_t before = cameras.sets.size();
        for (int i = 0; i < 3; ++i) {
          cameras.deliver(1.7e9 + 10.0 + i * kPeriod);
        }
        EXPECT_GT(cameras.sets.size(), before) << first << ", " << second << ", " << third;
      }
    }
  }
}

TEST(CloudSynchronizer, ForgetsWhatWaits)
{
  Cameras cameras(2);
  cameras.add(0, kStart);
  cameras.restart();
  cameras.add(1, kStart);
  EXPECT_TRUE(cameras.sets.empty());
  cameras.restart();
  cameras.deliver(kStart - 500.0);
  EXPECT_FALSE(cameras.sets.empty());
}

}  // namespace
}  // namespace grasp_affordances
