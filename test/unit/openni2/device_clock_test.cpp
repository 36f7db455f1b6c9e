#include "openni2/device_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

namespace grasp_affordances
{
namespace
{

constexpr std::int64_t kMicrosecond = 1000;  // ns
constexpr std::int64_t kMillisecond = 1000 * kMicrosecond;
constexpr std::int64_t kSecond = 1000 * kMillisecond;
constexpr std::int64_t kStart = 1'600'000'000 * kSecond;  // by the host
constexpr std::int64_t kPeriod = 33'333'333;              // ns, of the frames

/// A device whose clock runs fast by a few ppm (or slow), seen through transfers that take a little, and at times a
/// lot.
class Frames
{
public:
  explicit Frames(double ppm) : ppm_(ppm) {}

  struct Frame
  {
    std::int64_t true_ns;
    std::uint64_t device_us;
    std::int64_t arrival_ns;
  };

  Frame next()
  {
    const std::int64_t since_start = kPeriod * number_++;
    Frame frame;
    frame.true_ns = kStart + since_start;
    frame.device_us = 5'000'000 + std::llround(static_cast<double>(since_start) * (1.0 + 1e-6 * ppm_) / 1e3);
    const double late = number_ % 20 == 0 ? 25.0 : 0.0;  // ms
    frame.arrival_ns = frame.true_ns + std::llround(1e6 * (late + delay_(random_)));
    frame.arrival_ns = std::max(frame.arrival_ns, last_arrival_);
    last_arrival_ = frame.arrival_ns;
    return frame;
  }

private:
  double ppm_;
  std::int64_t number_ = 0;
  std::int64_t last_arrival_ = 0;
  std::mt19937 random_{1};
  std::exponential_distribution<double> delay_{1.0 / 2.0};  // 1 / ms
};

class DeviceClockDrift : public testing::TestWithParam<double>
{
};

// The least delayed of the 150 frames in 5 s is late by 2 ms / 150 on average; 50 ppm of 5 s are 0.25 ms.
TEST_P(DeviceClockDrift, IsFollowedForAnHour)
{
  Frames frames(GetParam());
  DeviceClock clock;
  std::int64_t last = 0;
  std::int64_t worst = 0;
  for (std::int64_t i = 0; i < 3600 * kSecond / kPeriod; ++i) {
    const Frames::Frame frame = frames.next();
    const std::int64_t told = clock.hostTime(frame.device_us, frame.arrival_ns);
    ASSERT_GT(told, last);
    ASSERT_LE(told, frame.arrival_ns);
    last = told;
    if (i > 5 * kSecond / kPeriod) {
      worst = std::max(worst, std::abs(told - frame.true_ns));
    }
  }
  EXPECT_LT(worst, 700 * kMicrosecond);
}

INSTANTIATE_TEST_SUITE_P(Ppm, DeviceClockDrift, testing::Values(-50.0, 0.0, 50.0));

TEST(DeviceClock, BeginsWithTheFirstArrival)
{
  DeviceClock clock;
  EXPECT_EQ(clock.hostTime(123'456, kStart), kStart);
}

TEST(DeviceClock, SmoothsAFrameThatWasHeldUp)
{
  DeviceClock clock;
  clock.hostTime(0, kStart);
  EXPECT_EQ(clock.hostTime(33'333, kStart + 90 * kMillisecond), kStart + 33'333 * kMicrosecond);
}

// Two frames that were held up arrive together with the third.
TEST(DeviceClock, AFirstFrameThatWasHeldUpIsForgivenWithoutGoingBack)
{
  DeviceClock clock;
  const std::int64_t together = kStart + 100 * kMillisecond;
  std::int64_t last = 0;
  for (const std::uint64_t device_us : {0, 33'333, 66'666}) {
    const std::int64_t told = clock.hostTime(device_us, together);
    EXPECT_GT(told, last);
    EXPECT_NEAR(static_cast<double>(told - together), 0.0, 10.0);
    last = told;
  }
  EXPECT_EQ(clock.hostTime(100'000, kStart + 101 * kMillisecond), kStart + 101 * kMillisecond);
}

TEST(DeviceClock, ARecordingThatBeginsAgainGoesOn)
{
  DeviceClock clock;
  clock.hostTime(0, kStart);
  const std::int64_t before = clock.hostTime(10'000'000, kStart + 10 * kSecond);
  const std::int64_t after = clock.hostTime(0, kStart + 11 * kSecond);
  EXPECT_GT(after, before);
  EXPECT_EQ(after, kStart + 11 * kSecond);
  EXPECT_EQ(clock.hostTime(33'333, kStart + 12 * kSecond), after + 33'333 * kMicrosecond);
}

TEST(DeviceClock, AnotherDeviceWithALaterClockIsBelievedAtOnce)
{
  DeviceClock clock;
  clock.hostTime(0, kStart);
  EXPECT_EQ(clock.hostTime(3'000'000, kStart + kSecond), kStart + kSecond);
  EXPECT_EQ(clock.hostTime(900'000'000, kStart + 2 * kSecond), kStart + 2 * kSecond);
}

TEST(DeviceClock, IsRightAtOnceAfterAPauseInWhichTheDevicesClockStood)
{
  DeviceClock clock;
  clock.hostTime(0, kStart);
  clock.hostTime(33'333, kStart + 33'333 * kMicrosecond);
  clock.restart();
  EXPECT_EQ(clock.hostTime(66'666, kStart + 60 * kSecond), kStart + 60 * kSecond);
  clock.restart();
  EXPECT_EQ(clock.hostTime(99'999, kStart + 60 * kSecond), kStart + 60 * kSecond + 1);  // they grow nevertheless
}

TEST(DeviceClock, FollowsAHostClockThatIsSetBackAtOnce)
{
  DeviceClock clock;
  clock.hostTime(0, kStart);
  EXPECT_EQ(clock.hostTime(33'333, kStart - 100 * kSecond), kStart - 100 * kSecond);
  EXPECT_EQ(clock.hostTime(66'666, kStart - 99 * kSecond), kStart - 100 * kSecond + 33'333 * kMicrosecond);
}

TEST(DeviceClock, GoesOnWhereTheDevicesClockStands)
{
  DeviceClock clock;
  clock.hostTime(40'000'000, kStart);
  for (int i = 1; i < 300; ++i) {
    ASSERT_EQ(clock.hostTime(40'000'000, kStart + i * kPeriod), kStart + i * kPeriod);
  }
}

TEST(DeviceClock, TimesOfTheDeviceThatAreNoneAreTakenLikeAnyOther)
{
  DeviceClock clock;
  std::int64_t arrival = kStart;
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
  for (const std::uint64_t device_us :
       {std::uint64_t{1'000'000}, kLargest, kLargest - 1, kLargest / 2, kLargest / 2 + 1, kLargest / 1000,
        std::uint64_t{0}, kLargest / 2000, kLargest / 4, std::uint64_t{33'333}}) {
    arrival += kPeriod;
    ASSERT_EQ(clock.hostTime(device_us, arrival), arrival) << device_us;
  }
}

TEST(DeviceClock, FollowsAHostClockThatIsSetForwardInSeconds)
{
  DeviceClock clock;
  std::int64_t error = 0;
  for (std::int64_t i = 0; i <= 11 * kSecond / kPeriod; ++i) {
    const std::int64_t host = kStart + i * kPeriod + (i * kPeriod > 5 * kSecond ? 100 * kSecond : 0);
    error = host - clock.hostTime(i * kPeriod / kMicrosecond, host);
  }
  EXPECT_LT(error, kMillisecond);
}

}  // namespace
}  // namespace grasp_affordances
