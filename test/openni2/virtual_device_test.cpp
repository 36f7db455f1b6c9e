#include "openni2/openni2_test_support.h"
#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <Eigen/Geometry>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

const char* const kOneDevice = "[{uri: test/1, serial: S1, scene: table, seed: 3, frames: 3}]";
constexpr int kFrames = 3;

Frame simulated(std::uint64_t seed, int number)
{
  const View view = makeScene("table", seed);
  return DepthCamera().capture(view.scene, view.T_scene_camera, seed + number);
}

/// What the device sends of a simulated depth image: its last pixel is that beside it.
std::vector<std::uint16_t> sent(std::vector<std::uint16_t> depth)
{
  depth.back() = depth[depth.size() - 2];
  return depth;
}

class VirtualDeviceTest : public OpenNi2Test
{
};

TEST_F(VirtualDeviceTest, DepthFramesAreThoseOfTheSimulatorInTurn)
{
  initialize(kOneDevice);
  openni::Device device;
  open(device, openni::ANY_DEVICE);
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  for (const ReceivedFrame& frame : receive(depth, 2 * kFrames)) {
    EXPECT_EQ(frame.width, 640);
    EXPECT_EQ(frame.height, 480);
    EXPECT_TRUE(frame.depth() == sent(simulated(3, frame.index % kFrames).depth)) << "frame " << frame.index;
  }
}

TEST_F(VirtualDeviceTest, FramesAreAThirtiethOfASecondApartByTheDevicesClock)
{
  initialize(kOneDevice);
  openni::Device device;
  const auto before = std::chrono::steady_clock::now();
  open(device, "test/1");
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  int last = 0;
  for (int n = 0; n < 30; ++n) {
    ReceivedFrame frame;
    ASSERT_TRUE(receive(depth, frame));
    EXPECT_GT(frame.index, last);
    last = frame.index;
    EXPECT_EQ(frame.timestamp, static_cast<std::uint64_t>(frame.index) * 1000000 / 30);
    EXPECT_GE(std::chrono::steady_clock::now() - before, std::chrono::microseconds(frame.timestamp)) << "too early";
  }
}

TEST_F(VirtualDeviceTest, TellsWhatAnXtionTells)
{
  initialize(kOneDevice);
  openni::Device device;
  open(device, "test/1");
  char serial[64];
  int size = sizeof(serial);
  require(device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size));
  EXPECT_STREQ(serial, "S1");
  EXPECT_TRUE(device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  EXPECT_FALSE(device.hasSensor(openni::SENSOR_IR));

  const SensorModel model;
  for (const openni::SensorType sensor : {openni::SENSOR_DEPTH, openni::SENSOR_COLOR}) {
    const auto& modes = device.getSensorInfo(sensor)->getSupportedVideoModes();
    ASSERT_EQ(modes.getSize(), 2);
    openni::VideoStream stream;
    require(stream.create(device, sensor));
    EXPECT_TRUE(stream.getMirroringEnabled());
    EXPECT_NEAR(320.0 / std::tan(stream.getHorizontalFieldOfView() / 2.0), model.intrinsics.fx, 1e-3);
    EXPECT_NEAR(240.0 / std::tan(stream.getVerticalFieldOfView() / 2.0), model.intrinsics.fy, 1e-3);
    EXPECT_FALSE(stream.isCroppingSupported());
    EXPECT_EQ(stream.getVideoMode().getFps(), 30);

    openni::VideoMode unknown = modes[0];
    unknown.setFps(60);
    EXPECT_NE(stream.setVideoMode(unknown), openni::STATUS_OK);
    EXPECT_EQ(stream.setVideoMode(modes[1]), openni::STATUS_OK);
    EXPECT_EQ(stream.getVideoMode().getResolutionX(), 320);
  }
  EXPECT_EQ(device.getSensorInfo(openni::SENSOR_DEPTH)->getSupportedVideoModes()[0].getPixelFormat(),
            openni::PIXEL_FORMAT_DEPTH_1_MM);
  EXPECT_EQ(device.getSensorInfo(openni::SENSOR_COLOR)->getSupportedVideoModes()[0].getPixelFormat(),
            openni::PIXEL_FORMAT_RGB888);
}

TEST_F(VirtualDeviceTest, SmallFramesHoldEverySecondPixelAndMirroredOnesAreMirrored)
{
  initialize(kOneDevice);
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  require(depth.create(device, openni::SENSOR_DEPTH));
  require(depth.setVideoMode(device.getSensorInfo(openni::SENSOR_DEPTH)->getSupportedVideoModes()[1]));
  require(depth.start());
  const ReceivedFrame frame = receive(depth, 1).front();
  ASSERT_EQ(frame.data.size(), 2U * 320 * 240);
  const auto whole = simulated(3, frame.index % kFrames).depth;
  std::vector<std::uint16_t> expected;
  for (int row = 0; row < 240; ++row) {
    for (int column = 319; column >= 0; --column)
      expected.push_back(whole[2 * row * 640 + 2 * column]);
  }
  EXPECT_TRUE(frame.depth() == sent(expected));
}

TEST_F(VirtualDeviceTest, RegisteredDepthIsWhatTheColorCameraWouldMeasure)
{
  initialize(kOneDevice);
  openni::Device device;
  open(device, "test/1");
  require(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  EXPECT_EQ(device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  const std::vector<std::uint16_t> registered = receive(depth, 1).front().depth();

  SensorModel exact;
  exact.exact = true;
  View view = makeScene("table", 3);
  view.T_scene_camera.translate(Eigen::Vector3d(0.025, 0.0, 0.0));
  const auto truth = DepthCamera(exact).capture(view.scene, view.T_scene_camera, 1).depth;
  int compared = 0;
  int near = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == 0 || registered[i] == 0)
      continue;
    ++compared;
    // Up to 4 standard deviations of the noise at 1 m and half a pixel of a slanted surface.
    near += std::abs(truth[i] - registered[i]) < 12 ? 1 : 0;
  }
  EXPECT_GT(compared, 150000);
  EXPECT_GT(near, 0.97 * compared);
}

TEST_F(VirtualDeviceTest, ColorFramesAreTakenWithTheDepthFramesAndShowTheSameObjects)
{
  initialize(kOneDevice);
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  openni::VideoStream color;
  start(depth, device, openni::SENSOR_DEPTH);
  start(color, device, openni::SENSOR_COLOR);
  const ReceivedFrame image = receive(color, 1).front();
  const ReceivedFrame range = receive(depth, 1).front();
  for (const ReceivedFrame& frame : {image, range})
    EXPECT_EQ(frame.timestamp, static_cast<std::uint64_t>(frame.index) * 1000000 / 30);
  ASSERT_EQ(image.data.size(), 3U * 640 * 480);

  // Off: no frames of color any more, but of depth.
  color.stop();
  EXPECT_TRUE(fallsSilent(color));
  receive(depth, 1);

  // One hue to an object.
  View view = makeScene("table", 3);
  view.T_scene_camera.translate(Eigen::Vector3d(0.025, 0.0, 0.0));
  SensorModel exact;
  exact.exact = true;
  const Frame truth = DepthCamera(exact).capture(view.scene, view.T_scene_camera, 1);
  std::vector<Eigen::Vector3d> hues(view.scene.objects().size(), Eigen::Vector3d::Zero());
  int of_that_hue = 0;
  int seen = 0;
  for (std::size_t i = 0; i < truth.parts.size(); ++i) {
    const auto* pixel = reinterpret_cast<const unsigned char*>(&image.data[3 * i]);
    const Eigen::Vector3d rgb(pixel[0], pixel[1], pixel[2]);
    if (truth.parts[i] < 0)
      continue;
    Eigen::Vector3d& hue = hues[view.scene.parts()[truth.parts[i]].object];
    if (hue.isZero())
      hue = rgb.normalized();
    ++seen;
    of_that_hue += hue.dot(rgb.normalized()) > 0.999 ? 1 : 0;
  }
  EXPECT_GT(seen, 200000);
  EXPECT_GT(of_that_hue, 0.99 * seen);
}

TEST_F(VirtualDeviceTest, TwoDevicesAtOnceEachHaveTheirOwnFrames)
{
  initialize("[{uri: test/1, seed: 3, frames: 2}, {uri: test/2, seed: 4, frames: 2}]");
  openni::Device devices[2];
  openni::VideoStream streams[2];
  for (int n = 0; n < 2; ++n) {
    open(devices[n], n == 0 ? "test/1" : "test/2");
    start(streams[n], devices[n], openni::SENSOR_DEPTH);
  }
  for (int n = 0; n < 2; ++n) {
    for (const ReceivedFrame& frame : receive(streams[n], 2))
      EXPECT_TRUE(frame.depth() == sent(simulated(3 + n, frame.index % 2).depth)) << n;
  }
}

TEST_F(VirtualDeviceTest, ACameraBesideLooksFromThereWithItsOwnNoise)
{
  initialize("[{uri: test/1, seed: 3, frames: 1, turn_deg: 30, noise_seed: 7}]");
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  const View view = viewFromAside(makeScene("table", 3), kDegree * 30.0);
  EXPECT_TRUE(receive(depth, 1).front().depth() ==
              sent(DepthCamera().capture(view.scene, view.T_scene_camera, 3 + 7).depth));
}

TEST_F(VirtualDeviceTest, AnUnpluggedDeviceIsReportedAndSilentAndCanBeOpenedOnceItIsBack)
{
  initialize(kOneDevice);
  BusListener events;
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  receive(depth, 1);

  bus_.write("[{uri: test/1, serial: S1, scene: table, seed: 3, frames: 3, state: unplugged}]");
  EXPECT_EQ(events.wait(1), std::vector<std::string>{"-test/1"});
  EXPECT_TRUE(fallsSilent(depth));
  EXPECT_NE(openni::Device().open("test/1"), openni::STATUS_OK);
  depth.stop();
  depth.destroy();
  device.close();

  bus_.write(kOneDevice);
  EXPECT_EQ(events.wait(2), (std::vector<std::string>{"-test/1", "+test/1"}));
  const auto before = std::chrono::steady_clock::now();
  open(device, "test/1");
  start(depth, device, openni::SENSOR_DEPTH);
  const std::chrono::microseconds timestamp(receive(depth, 1).front().timestamp);
  EXPECT_GE(std::chrono::steady_clock::now() - before, timestamp) << "its clock began anew";
}

TEST_F(VirtualDeviceTest, ADeviceThatIsPluggedInLaterIsReported)
{
  initialize("[]");
  BusListener events;
  EXPECT_NE(openni::Device().open(openni::ANY_DEVICE), openni::STATUS_OK);
  bus_.write(kOneDevice);
  EXPECT_EQ(events.wait(1), std::vector<std::string>{"+test/1"});
  openni::Device device;
  open(device, openni::ANY_DEVICE);
}

TEST_F(VirtualDeviceTest, AStalledDeviceIsThereButSilent)
{
  initialize(kOneDevice);
  BusListener events;
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  const int before = receive(depth, 1).front().index;
  bus_.write("[{uri: test/1, serial: S1, scene: table, seed: 3, frames: 3, state: stalled}]");
  EXPECT_TRUE(fallsSilent(depth));
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  EXPECT_EQ(devices.getSize(), 1);
  bus_.write(kOneDevice);
  EXPECT_GT(receive(depth, 1).front().index, before + 8);  // the clock went on
  EXPECT_TRUE(events.wait(0).empty());
}

TEST_F(VirtualDeviceTest, ACorruptDeviceSendsIncompleteFrames)
{
  initialize("[{uri: test/1, scene: table, seed: 3, frames: 3, state: corrupt}]");
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  for (const ReceivedFrame& frame : receive(depth, 6)) {
    const std::size_t sizes[] = {2 * 640 * 360, 2 * 640 * 240, 0};
    EXPECT_EQ(frame.data.size(), sizes[frame.index % 3]);
    EXPECT_EQ(frame.height, frame.index % 3 == 1 ? 240 : 480);
  }
}

TEST_F(VirtualDeviceTest, AListThatCannotBeReadIsSaidOnceAndChangesNothing)
{
  initialize(kOneDevice);
  BusListener events;
  openni::Device device;
  open(device, "test/1");
  openni::VideoStream depth;
  start(depth, device, openni::SENSOR_DEPTH);
  testing::internal::CaptureStderr();
  bus_.write("[{uri: test/1, scene: tabel}]");
  receive(depth, 10);  // while it is read ten times or so
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("there is no scene 'tabel'"), std::string::npos) << said;
  EXPECT_EQ(said.find("tabel"), said.rfind("tabel")) << said;
  EXPECT_TRUE(events.wait(0).empty());
}

TEST_F(VirtualDeviceTest, WithoutAListThereIsOneDevice)
{
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before there is another thread
  unsetenv("GRASP_AFFORDANCES_VIRTUAL_DEVICES");
  require(openni::OpenNI::initialize());
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  ASSERT_EQ(devices.getSize(), 1);
  EXPECT_STREQ(devices[0].getUri(), "virtual/1");
}

TEST_F(VirtualDeviceTest, TheRuntimeEndsAndBeginsAnewWithStreamsLeftRunning)
{
  for (int round = 0; round < 3; ++round) {
    initialize(kOneDevice);
    openni::Device device;
    open(device, "test/1");
    openni::VideoStream depth;
    start(depth, device, openni::SENSOR_DEPTH);
    if (round > 0)
      receive(depth, 1);
    openni::OpenNI::shutdown();
  }
  initialize(kOneDevice);
}

/// A list that is refused, and a part of what is said.
struct BadList
{
  const char* list;
  const char* message;
};

class BadListTest : public OpenNi2Test, public testing::WithParamInterface<BadList>
{
};

TEST_P(BadListTest, IsSaidAndThereIsNoDevice)
{
  testing::internal::CaptureStderr();
  initialize(GetParam().list);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find(GetParam().message), std::string::npos) << said;
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  EXPECT_EQ(devices.getSize(), 0);
}

INSTANTIATE_TEST_SUITE_P(Lists, BadListTest,
                         testing::Values(BadList{"{uri: a}", "not a list"}, BadList{"[{serial: a}]", "no uri"},
                                         BadList{"[{uri: a}, {uri: a}]", "comes twice"},
                                         BadList{"[{uri: a, colour: red}]", "'colour'"},
                                         BadList{"[{uri: a, state: broken}]", "plugged, unplugged, stalled, corrupt"},
                                         BadList{"[{uri: a, frames: 0}]", "frames must be in 1 to 1000"},
                                         BadList{"[{uri: a, seed: -1}]", "bad conversion"},
                                         BadList{"[{uri: ", "end of"}));

}  // namespace
}  // namespace grasp_affordances
