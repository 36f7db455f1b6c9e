#include "nodelets/roscpp/cloud_clock.h"

#include <gtest/gtest.h>

#include <chrono>

namespace grasp_affordances
{
namespace
{

/// Clouds that arrive at times of their own.
class CloudClockTest : public testing::Test
{
protected:
  /// @param arrival  s since some moment
  CloudClock::Reading read(double stamp, double arrival)
  {
    const auto after = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(kArrivalEpoch + arrival));
    return clock_.read(ros::Time(stamp), CloudClock::Arrival(after));
  }

  static constexpr double kArrivalEpoch = 5000.0;
  CloudClock clock_;
};

TEST_F(CloudClockTest, StampsThatAdvanceAreTheTime)
{
  for (int i = 0; i < 10; ++i) {
    const double stamp = 100.0 + 0.25 * i;
    const CloudClock::Reading reading = read(stamp, 7.0 * i);
    EXPECT_EQ(reading.time, ros::Time(stamp).toSec());  // bit for bit
    EXPECT_FALSE(reading.began_anew);
    EXPECT_FALSE(clock_.countsArrivals());
  }
}

TEST_F(CloudClockTest, WhereStampsStandStillArrivalsCount)
{
  read(100.0, 0.0);
  EXPECT_EQ(read(100.0, 0.25).time, 100.0) << "the same cloud again";
  EXPECT_FALSE(clock_.countsArrivals());
  EXPECT_NEAR(read(100.0, 2.0).time, 102.0, 1e-9);
  EXPECT_TRUE(clock_.countsArrivals());
  EXPECT_NEAR(read(100.0, 3.0).time, 103.0, 1e-9);
  // The stamps go on: time does, too, from where it is.
  EXPECT_NEAR(read(100.25, 3.25).time, 103.0, 1e-9);
  EXPECT_FALSE(clock_.countsArrivals());
  EXPECT_NEAR(read(101.25, 4.25).time, 104.0, 1e-9);
}

TEST_F(CloudClockTest, WithoutStampsArrivalsCountAtOnce)
{
  const double first = read(0.0, 1.0).time;
  EXPECT_TRUE(clock_.countsArrivals());
  EXPECT_NEAR(read(0.0, 1.25).time - first, 0.25, 1e-9);
  EXPECT_FALSE(read(0.0, 1.5).began_anew);
}

TEST_F(CloudClockTest, LateCloudsHaveTheTimeOfTheNewest)
{
  read(100.0, 0.0);
  read(100.5, 0.25);
  const CloudClock::Reading late = read(100.25, 0.3);
  EXPECT_EQ(late.time, 100.5);
  EXPECT_FALSE(late.began_anew);
  EXPECT_EQ(read(100.75, 0.4).time, 100.75);
}

TEST_F(CloudClockTest, StampsThatGoBackBeginAnew)
{
  read(100.0, 0.0);
  read(200.0, 0.1);
  const CloudClock::Reading anew = read(100.0, 0.2);
  EXPECT_TRUE(anew.began_anew);
  EXPECT_EQ(anew.time, 100.0);
  EXPECT_FALSE(read(100.1, 0.3).began_anew);
}

TEST_F(CloudClockTest, StampsDecadesApartAreNoError)
{
  read(1.0, 0.0);
  EXPECT_EQ(read(4e9, 0.1).time, 4e9);
  EXPECT_TRUE(read(1.0, 0.2).began_anew);
}

}  // namespace
}  // namespace grasp_affordances
