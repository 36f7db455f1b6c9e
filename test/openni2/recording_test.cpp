#include "openni2/openni2_test_support.h"

#include <chrono>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace grasp_affordances
{
namespace
{

// One recorder per process is what OpenNI2 2.2 bears; each test is a process of its own.
class RecordingTest : public OpenNi2Test
{
protected:
  void SetUp() override { initialize("[{uri: test/1, scene: table, seed: 3, frames: 3}]"); }

  void TearDown() override
  {
    OpenNi2Test::TearDown();
    std::remove(file_.c_str());
  }

  /// Records the frames of streams that stand still; returns those of the first one.
  std::vector<ReceivedFrame> record(const std::vector<openni::VideoStream*>& streams, std::size_t frames) const
  {
    openni::Recorder recorder;
    require(recorder.create(file_.c_str()));
    for (openni::VideoStream* stream : streams)
      require(recorder.attach(*stream));
    require(recorder.start());
    for (openni::VideoStream* stream : streams)
      require(stream->start());
    std::vector<ReceivedFrame> received = receive(*streams.front(), frames);
    // Before the recorder: OpenNI2 may deadlock when a frame comes while a recorder lets go of its stream.
    for (openni::VideoStream* stream : streams)
      stream->stop();
    recorder.stop();
    recorder.destroy();
    return received;
  }

  /// OpenNI2's player walks its list of streams without a lock, but sleeps between two rounds once they are stopped.
  static void destroyPlayed(openni::VideoStream& stream)
  {
    stream.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stream.destroy();
  }

  const std::string file_ = testing::TempDir() + "recording_" + std::to_string(getpid()) + ".oni";
};

TEST_F(RecordingTest, IsPlayedBackBitForBit)
{
  float field_of_view = 0.0F;
  std::vector<ReceivedFrame> live;
  {
    openni::Device device;
    open(device, "test/1");
    openni::VideoStream depth;
    create(depth, device, openni::SENSOR_DEPTH);
    field_of_view = depth.getHorizontalFieldOfView();
    live = record({&depth}, 12);
  }

  openni::Device device;
  open(device, file_.c_str());
  device.getPlaybackControl()->setSpeed(-1);  // frame by frame, none is dropped
  device.getPlaybackControl()->setRepeatEnabled(false);
  openni::VideoStream depth;
  require(depth.create(device, openni::SENSOR_DEPTH));
  EXPECT_EQ(depth.getHorizontalFieldOfView(), field_of_view);
  require(depth.start());
  const int frames = device.getPlaybackControl()->getNumberOfFrames(depth);
  EXPECT_GE(frames, 10);
  const std::vector<ReceivedFrame> played = receive(depth, frames);
  EXPECT_EQ(played.front().index, 1);
  EXPECT_EQ(played.front().timestamp, 0U);

  std::map<std::string, int> contents;
  for (const ReceivedFrame& frame : live)
    contents.emplace(frame.data, frame.index % 3);
  EXPECT_EQ(contents.size(), 3U);
  std::set<int> contents_played;
  for (const ReceivedFrame& frame : played) {
    const auto content = contents.find(frame.data);
    EXPECT_TRUE(content != contents.end()) << "frame " << frame.index;
    if (content != contents.end())
      contents_played.insert(content->second);
  }
  EXPECT_EQ(contents_played.size(), 3U);
  destroyPlayed(depth);
}

TEST_F(RecordingTest, HoldsColorAsItWas)
{
  std::string live;
  {
    openni::Device device;
    open(device, "test/1");
    openni::VideoStream depth;
    openni::VideoStream color;
    create(depth, device, openni::SENSOR_DEPTH);
    create(color, device, openni::SENSOR_COLOR);
    live = record({&color, &depth}, 6).front().data;
  }
  openni::Device device;
  open(device, file_.c_str());
  openni::VideoStream color;
  require(color.create(device, openni::SENSOR_COLOR));
  require(color.start());
  EXPECT_TRUE(receive(color, 1).front().data == live);
  destroyPlayed(color);
}

}  // namespace
}  // namespace grasp_affordances
