#include "openni2/device.h"

#include "openni2/device_error.h"
#include "openni2/openni2_test_support.h"

#include <unistd.h>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace grasp_affordances
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPoll(100);

/// One device of one picture, in a state.
std::string bus(const std::string& state)
{
  return "[{uri: test/1, serial: A1, scene: table, seed: 3, frames: 1, state: " + state + "}]";
}

DeviceRequest requested(const std::string& id)
{
  DeviceRequest request;
  request.id = id;
  return request;
}

std::string refusal(const DeviceRequest& request)
{
  try {
    const Device device(request);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

/// Reads on until something is as it should be. @return whether it was, before patience ran out
bool readUntil(Device& device, const std::function<bool(const std::optional<DeviceFrame>&)>& accept)
{
  const auto end = Clock::now() + kPatience;
  while (Clock::now() < end) {
    if (accept(device.read(kPoll))) {
      return true;
    }
  }
  return false;
}

bool isIntactFrame(const std::optional<DeviceFrame>& frame)
{
  return frame && frame->intact;
}

std::vector<std::uint16_t> nextDepth(Device& device)
{
  const ImageLayout& layout = device.layout(Sensor::depth);
  std::vector<std::uint16_t> depth(static_cast<std::size_t>(layout.width) * layout.height);
  EXPECT_TRUE(readUntil(device, [&](const std::optional<DeviceFrame>& frame) {
    if (isIntactFrame(frame)) {
      depthMillimetres(frame->image, layout, {}, depth.data());
    }
    return isIntactFrame(frame);
  }));
  return depth;
}

class DeviceTest : public OpenNi2Test
{
};

TEST_F(DeviceTest, IsOpenedByUriSerialOrNumber)
{
  initialize(bus("plugged"));
  for (const std::string id : {"", "#1", "test/1", "A1"}) {
    const Device device(requested(id));
    EXPECT_EQ(device.uri(), "test/1");
    EXPECT_EQ(device.serial(), "A1");
    EXPECT_FALSE(device.isRecording());
    EXPECT_TRUE(device.has(Sensor::depth));
    EXPECT_FALSE(device.has(Sensor::color));
  }
}

TEST_F(DeviceTest, RefusalsSayWhatThereIs)
{
  initialize(bus("plugged"));
  EXPECT_EQ(refusal(requested("B2")), "no device is B2; connected: test/1");
  DeviceRequest request = requested("");
  request.depth_mode = {320, 240, 7};
  EXPECT_EQ(refusal(request), "test/1, depth: no mode 320x240@7 among 320x240@30 640x480@30");
  EXPECT_NE(refusal(requested("missing.oni")).find("missing.oni cannot be opened: "), std::string::npos);
}

TEST_F(DeviceTest, RunsOnlyWhatItIsTold)
{
  initialize(bus("plugged"));
  DeviceRequest request = requested("");
  request.color_mode = FrameMode{320, 240, 30};
  Device device(request);
  device.run(Sensor::color, true);
  EXPECT_FALSE(device.runs(Sensor::depth));
  for (int i = 0; i < 4; ++i) {
    std::optional<Sensor> sensor;
    ASSERT_TRUE(readUntil(device, [&](const std::optional<DeviceFrame>& frame) {
      sensor = frame ? std::make_optional(frame->sensor) : std::nullopt;
      return isIntactFrame(frame);
    }));
    EXPECT_EQ(sensor, Sensor::color);
  }

  device.run(Sensor::depth, true);
  device.run(Sensor::color, false);
  EXPECT_TRUE(readUntil(device, [](const std::optional<DeviceFrame>& frame) {
    return isIntactFrame(frame) && frame->sensor == Sensor::depth && frame->image.width == 640;
  }));
}

TEST_F(DeviceTest, WaitsForASilentDeviceNoLongerThanTold)
{
  initialize(bus("stalled"));
  Device device(requested(""));
  device.run(Sensor::depth, true);
  const auto begin = Clock::now();
  EXPECT_FALSE(device.read(kPoll));
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(2));
  EXPECT_TRUE(device.connected());
}

TEST_F(DeviceTest, TellsThatItWasPulledOutAndIsFoundAgain)
{
  initialize(bus("plugged"));
  {
    Device device(requested(""));
    device.run(Sensor::depth, true);
    ASSERT_TRUE(readUntil(device, isIntactFrame));
    bus_.write(bus("unplugged"));
    EXPECT_TRUE(readUntil(device, [&](const std::optional<DeviceFrame>&) { return !device.connected(); }));
    EXPECT_TRUE(readUntil(device, [](const std::optional<DeviceFrame>& frame) { return !frame; }));
    EXPECT_EQ(refusal(requested("")), "none is connected");
  }
  bus_.write(bus("plugged"));
  const auto end = Clock::now() + kPatience;
  while (!refusal(requested("")).empty() && Clock::now() < end) {
    std::this_thread::sleep_for(kPoll);
  }
  Device device(requested(""));
  device.run(Sensor::depth, true);
  EXPECT_TRUE(readUntil(device, isIntactFrame));
}

TEST_F(DeviceTest, TellsTornFrames)
{
  initialize(bus("corrupt"));
  Device device(requested(""));
  device.run(Sensor::depth, true);
  EXPECT_TRUE(readUntil(device, [](const std::optional<DeviceFrame>& frame) { return frame && !frame->intact; }));
  bus_.write(bus("plugged"));
  EXPECT_TRUE(readUntil(device, isIntactFrame));
}

class PlaybackTest : public DeviceTest
{
protected:
  void TearDown() override
  {
    DeviceTest::TearDown();
    std::remove(file_.c_str());
  }

  void record(bool mirrored, std::size_t frames)
  {
    openni::Device device;
    open(device, "test/1");
    openni::VideoStream depth;
    start(depth, device, openni::SENSOR_DEPTH);
    ASSERT_EQ(depth.setMirroringEnabled(mirrored), openni::STATUS_OK);
    receive(depth, 2);  // those before the change
    openni::Recorder recorder;
    ASSERT_EQ(recorder.create(file_.c_str()), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
    ASSERT_EQ(recorder.attach(depth), openni::STATUS_OK);
    ASSERT_EQ(recorder.start(), openni::STATUS_OK);
    receive(depth, frames);
    recorder.stop();
    recorder.destroy();
  }

  const std::string file_ = testing::TempDir() + "played_" + std::to_string(getpid()) + ".oni";
};

// OpenNI2's player crashes, or never ends, where a stream is destroyed while it looks at it.
TEST_F(PlaybackTest, EndsAndBeginsAgainAnyNumberOfTimes)
{
  initialize(bus("plugged"));
  record(false, 4);
  for (int round = 0; round < 25; ++round) {
    Device device(requested(file_));
    EXPECT_TRUE(device.isRecording());
    device.run(Sensor::depth, true);
    int frames = 0;
    EXPECT_TRUE(readUntil(device, [&](const std::optional<DeviceFrame>& frame) {
      frames += isIntactFrame(frame) ? 1 : 0;
      return !frame && device.atEnd();
    }));
    EXPECT_GE(frames, 3) << round;
  }
}

TEST_F(PlaybackTest, TurnsMirroredRecordingsBack)
{
  initialize(bus("plugged"));
  record(true, 4);
  std::vector<std::uint16_t> live;
  {
    Device device(requested("test/1"));
    device.run(Sensor::depth, true);
    live = nextDepth(device);
  }
  Device played(requested(file_));
  EXPECT_TRUE(played.layout(Sensor::depth).mirrored);
  played.run(Sensor::depth, true);
  EXPECT_EQ(nextDepth(played), live);
}

}  // namespace
}  // namespace grasp_affordances
