#include "openni2/device_error.h"
#include "openni2/device_id.h"
#include "openni2/field_of_view.h"
#include "openni2/video_mode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

const std::vector<std::string> kUris = {"1d27/0601@1/5", "1d27/0601@2/5", "1d27/0601@2/11"};

std::string serialOf(const std::string& uri)
{
  return uri == kUris[1] ? "A2" : "";
}

std::string chosen(const std::string& id)
{
  return deviceUri(id, kUris, serialOf);
}

std::string refusal(const std::string& id, const std::vector<std::string>& uris)
{
  try {
    return "chose " + deviceUri(id, uris, serialOf);
  } catch (const DeviceNotFound& error) {
    return error.what();
  }
}

TEST(DeviceId, MeansAnyDeviceOrOneByNumberUriOrSerial)
{
  EXPECT_EQ(chosen(""), kUris[0]);
  EXPECT_EQ(chosen("#1"), kUris[0]);
  EXPECT_EQ(chosen("#3"), kUris[2]);
  EXPECT_EQ(chosen("1d27/0601@2/5"), kUris[1]);
  EXPECT_EQ(chosen("@2/11"), kUris[2]);
  EXPECT_EQ(chosen("A2"), kUris[1]);
}

TEST(DeviceId, RefusalListsTheConnectedDevices)
{
  const std::string list = "; connected: 1d27/0601@1/5 1d27/0601@2/5 1d27/0601@2/11";
  EXPECT_EQ(refusal("#4", kUris), "no device is #4" + list);
  EXPECT_EQ(refusal("#0", kUris), "no device is #0" + list);
  EXPECT_EQ(refusal("B7", kUris), "no device is B7" + list);
  EXPECT_EQ(refusal("@2", kUris), "more than one device is @2" + list);
  EXPECT_EQ(refusal("", {}), "none is connected");
}

TEST(DeviceId, SerialNumbersAreAskedForOnlyWhereNothingElseFits)
{
  const auto unwanted = [](const std::string&) -> std::string { throw std::logic_error("asked"); };
  for (const std::string id : {"", "#2", "1d27/0601@2/5", "@2/11"}) {
    EXPECT_NO_THROW(deviceUri(id, kUris, unwanted)) << id;
  }
}

TEST(DeviceId, RecordingsEndInOni)
{
  EXPECT_TRUE(isRecordingPath("table.oni"));
  EXPECT_FALSE(isRecordingPath(".oni"));
  EXPECT_FALSE(isRecordingPath("table.oni.bag"));
  EXPECT_FALSE(isRecordingPath(""));
}

openni::VideoMode videoMode(int width, int height, int rate, openni::PixelFormat format)
{
  openni::VideoMode mode;
  mode.setResolution(width, height);
  mode.setFps(rate);
  mode.setPixelFormat(format);
  return mode;
}

TEST(FrameMode, WordsAreReadAndWritten)
{
  const FrameMode mode = frameModeFromWord("1280x1024@15");
  EXPECT_EQ(mode.width, 1280);
  EXPECT_EQ(mode.height, 1024);
  EXPECT_EQ(mode.rate, 15);
  EXPECT_EQ(frameModeWord(mode), "1280x1024@15");
  for (const char* word :
       {"", "VGA", "640x480", "640x480@", "640x480@0", "-640x480@30", "640x480@30 ", "640x480@30Hz"}) {
    EXPECT_THROW(frameModeFromWord(word), std::invalid_argument) << word;
  }
}

TEST(FrameMode, TheBestPixelFormatIsChosen)
{
  const std::vector<openni::VideoMode> modes = {videoMode(640, 480, 30, openni::PIXEL_FORMAT_SHIFT_9_2),
                                                videoMode(640, 480, 30, openni::PIXEL_FORMAT_DEPTH_100_UM),
                                                videoMode(640, 480, 30, openni::PIXEL_FORMAT_DEPTH_1_MM),
                                                videoMode(320, 240, 60, openni::PIXEL_FORMAT_DEPTH_100_UM)};
  EXPECT_EQ(&supportedVideoMode("depth", openni::SENSOR_DEPTH, modes, {640, 480, 30}), &modes[2]);
  EXPECT_EQ(&supportedVideoMode("depth", openni::SENSOR_DEPTH, modes, {320, 240, 60}), &modes[3]);
}

TEST(FrameMode, RefusalListsWhatCouldHaveBeenAskedFor)
{
  const std::vector<openni::VideoMode> modes = {
      videoMode(640, 480, 30, openni::PIXEL_FORMAT_RGB888), videoMode(640, 480, 30, openni::PIXEL_FORMAT_YUV422),
      videoMode(1280, 1024, 30, openni::PIXEL_FORMAT_GRAY8), videoMode(320, 240, 30, openni::PIXEL_FORMAT_RGB888)};
  try {
    supportedVideoMode("color", openni::SENSOR_COLOR, modes, {1280, 1024, 30});
    FAIL();
  } catch (const DeviceError& error) {
    EXPECT_STREQ(error.what(), "color: no mode 1280x1024@30 among 320x240@30 640x480@30");
  }
}

/// As a recording may hold it: pixels of two bytes, of which three would be read.
TEST(FrameMode, AFormatOfTheOtherSensorIsNotRead)
{
  const FrameMode wanted{640, 480, 30};
  const std::pair<openni::SensorType, openni::PixelFormat> wrong[] = {
      {openni::SENSOR_COLOR, openni::PIXEL_FORMAT_DEPTH_1_MM},
      {openni::SENSOR_COLOR, openni::PIXEL_FORMAT_DEPTH_100_UM},
      {openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_RGB888}};
  for (const auto& [type, format] : wrong) {
    const std::vector<openni::VideoMode> modes = {videoMode(640, 480, 30, format)};
    EXPECT_THROW(supportedVideoMode("stream", type, modes, wanted), DeviceError) << type << ", " << format;
  }
}

// What an Xtion reports of its depth camera.
TEST(FieldOfView, GivesTheFocalLength)
{
  const auto intrinsics = pinholeIntrinsics({1.0226, 0.7966}, 640, 480);
  ASSERT_TRUE(intrinsics);
  EXPECT_NEAR(intrinsics->fx, 570.3, 0.1);
  EXPECT_NEAR(intrinsics->fy, 570.3, 0.1);
  EXPECT_EQ(intrinsics->cx, 319.5);
  EXPECT_EQ(intrinsics->cy, 239.5);
}

// Its first 960 rows are, at twice the size, the picture of 640x480; of them it reports the angle.
TEST(FieldOfView, OfTheLargestPictureIsThatOfItsFirstRows)
{
  const auto intrinsics = pinholeIntrinsics({1.0226, 0.7966}, 1280, 1024);
  ASSERT_TRUE(intrinsics);
  EXPECT_NEAR(intrinsics->fx, 2 * 570.3, 0.2);
  EXPECT_NEAR(intrinsics->fy, 2 * 570.3, 0.2);
  EXPECT_EQ(intrinsics->cx, 639.5);
  EXPECT_EQ(intrinsics->cy, 479.5);
}

TEST(FieldOfView, IsNotBelievedWhereItCannotBe)
{
  EXPECT_FALSE(pinholeIntrinsics({0.0, 0.8}, 640, 480));
  EXPECT_FALSE(pinholeIntrinsics({1.0, -0.8}, 640, 480));
  EXPECT_FALSE(pinholeIntrinsics({58.0, 45.0}, 640, 480));
  EXPECT_FALSE(pinholeIntrinsics({std::nan(""), 0.8}, 640, 480));
}

}  // namespace
}  // namespace grasp_affordances
