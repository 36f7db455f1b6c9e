#include "virtual_device/virtual_stream.h"

#include "virtual_device/property.h"
#include "virtual_device/virtual_device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ratio>

namespace grasp_affordances
{
namespace
{

using FramePeriod = std::chrono::duration<std::int64_t, std::ratio<1, 30>>;
using Rgb = std::array<std::uint8_t, 3>;

constexpr int kMaxDepth = 10000;  // mm, as an Xtion reports
constexpr int kMaxColor = 255;
constexpr int kLargest = std::numeric_limits<int>::max();
constexpr int kVanishingFrame = 5;

bool equal(const OniVideoMode& a, const OniVideoMode& b)
{
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY &&
         a.fps == b.fps;
}

float fieldOfView(std::uint32_t pixels, double focal_length)
{
  return static_cast<float>(2.0 * std::atan(0.5 * pixels / focal_length));
}

/// Copies every pixel, or every second pixel of every second row.
template <class Pixel>
void scan(const Pixel* image, int image_width, const OniVideoMode& mode, bool mirrored, Pixel* out)
{
  const int step = image_width / mode.resolutionX;
  for (int row = 0; row < mode.resolutionY; ++row, image += step * image_width) {
    for (int column = 0; column < mode.resolutionX; ++column)
      *out++ = image[step * (mirrored ? mode.resolutionX - 1 - column : column)];
  }
}

/// Truncates a frame as data loss on USB does. Three kinds alternate: three quarters of the bytes, half of the rows,
/// nothing.
void tear(OniFrame& frame)
{
  switch (frame.frameIndex % 3) {
    case 0:
      frame.dataSize = frame.dataSize / 4 * 3;
      break;
    case 1:
      frame.height /= 2;
      frame.dataSize = frame.height * frame.stride;
      break;
    default:
      frame.dataSize = 0;
  }
}

/// Gives a frame sizes that do not fit its mode; several kinds alternate. In the last one stride and number of bytes
/// are both negative, so that they fit each other.
void misshape(OniFrame& frame)
{
  switch (frame.frameIndex % 8) {
    case 0:
      frame.width *= 2;
      break;
    case 1:
      frame.height = kLargest;
      break;
    case 2:
      frame.width = frame.height = frame.stride = frame.dataSize = 0;
      break;
    case 3:
      frame.dataSize = kLargest;
      break;
    case 4:
      frame.stride = frame.width - 1;
      frame.dataSize = frame.height * frame.stride;
      break;
    case 5:
      frame.height = -frame.height;
      frame.dataSize = -frame.dataSize;
      break;
    case 6:
      frame.videoMode.pixelFormat = ONI_PIXEL_FORMAT_GRAY16;
      break;
    default:
      frame.stride = -frame.stride;
      frame.dataSize = -frame.dataSize;
  }
}

/// Reverses the lower half of a depth image, and fills the rows above it with depths that no device measures.
void garble(OniFrame& frame)
{
  auto* pixels = static_cast<OniDepthPixel*>(frame.data);
  const int half = frame.height / 2 * frame.width;
  std::reverse(pixels + half, pixels + 2 * half);
  for (int i = half - 8 * frame.width; i < half; ++i)
    pixels[i] = i % 3 == 0 ? 0xFFFF : static_cast<OniDepthPixel>(i % 3);
}

/// A clock that alternately is right, stands still, jumps back, jumps forward, and shows its least and its largest
/// time.
std::uint64_t wrongTime(int frame_index, std::uint64_t time)
{
  constexpr std::uint64_t kSecond = 1'000'000;  // us
  switch (frame_index / 4 % 6) {
    case 0:
      return time;
    case 1:
      return 40 * kSecond;
    case 2:
      return time / 2;
    case 3:
      return time + 3600 * kSecond;
    case 4:
      return 0;
    default:
      return std::numeric_limits<std::uint64_t>::max() - 1'000'000 + time % 1'000'000;
  }
}

}  // namespace

VirtualStream::VirtualStream(const VirtualDevice& device, const OniSensorInfo& sensor)
    : device_(device), sensor_(sensor), mode_(sensor.pSupportedVideoModes[0])
{
}

VirtualStream::~VirtualStream()
{
  VirtualStream::stop();
}

OniStatus VirtualStream::start()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (thread_.joinable())
    return ONI_STATUS_OUT_OF_FLOW;
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
  return ONI_STATUS_OK;
}

void VirtualStream::stop()
{
  std::thread thread;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    thread.swap(thread_);
  }
  stop_asked_.notify_all();
  if (thread.joinable())
    thread.join();
}

OniStatus VirtualStream::setProperty(int id, const void* data, int size)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE: {
      OniVideoMode mode;
      const OniStatus status = receiveProperty(data, size, mode);
      return status == ONI_STATUS_OK ? setVideoMode(mode) : status;
    }
    case ONI_STREAM_PROPERTY_MIRRORING: {
      OniBool mirrored = FALSE;
      const OniStatus status = receiveProperty(data, size, mirrored);
      if (status == ONI_STATUS_OK)
        mirrored_ = mirrored != FALSE;
      return status;
    }
    default:
      return ONI_STATUS_NOT_IMPLEMENTED;
  }
}

OniStatus VirtualStream::getProperty(int id, void* data, int* size)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const SensorModel& model = device_.camera().frames->model();
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answerProperty(mode_, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return answerProperty(OniBool{mirrored_}, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return answerProperty(fieldOfView(model.width, model.intrinsics.fx), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answerProperty(fieldOfView(model.height, model.intrinsics.fy), data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:  // a recorder drops depths above it
      return answerProperty(sensor_.sensorType == ONI_SENSOR_DEPTH ? kMaxDepth : kMaxColor, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answerProperty<int>(0, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:  // a recording of a stream without it does not play
      return answerProperty(OniCropping{}, data, size);
    default:
      return ONI_STATUS_NOT_IMPLEMENTED;
  }
}

OniBool VirtualStream::isPropertySupported(int id)
{
  constexpr std::array<int, 6> supported = {ONI_STREAM_PROPERTY_VIDEO_MODE,     ONI_STREAM_PROPERTY_MIRRORING,
                                            ONI_STREAM_PROPERTY_HORIZONTAL_FOV, ONI_STREAM_PROPERTY_VERTICAL_FOV,
                                            ONI_STREAM_PROPERTY_MAX_VALUE,      ONI_STREAM_PROPERTY_MIN_VALUE};
  return std::find(supported.begin(), supported.end(), id) != supported.end();
}

OniStatus VirtualStream::setVideoMode(const OniVideoMode& mode)
{
  const OniVideoMode* modes = sensor_.pSupportedVideoModes;
  if (std::none_of(modes, modes + sensor_.numSupportedVideoModes,
                   [&](const auto& known) { return equal(known, mode); }))
    return ONI_STATUS_NOT_SUPPORTED;
  if (thread_.joinable())
    return ONI_STATUS_OUT_OF_FLOW;
  mode_ = mode;
  return ONI_STATUS_OK;
}

void VirtualStream::run()
{
  using std::chrono::steady_clock;
  std::unique_lock<std::mutex> lock(mutex_);
  for (FramePeriod last(0);;) {
    const auto passed = std::chrono::duration_cast<FramePeriod>(steady_clock::now() - device_.opened());
    const FramePeriod next = std::max(passed, last) + FramePeriod(1);
    const auto due = device_.opened() + std::chrono::duration_cast<steady_clock::duration>(next);
    if (stop_asked_.wait_until(lock, due, [this] { return stopping_; }))
      return;
    lock.unlock();  // OpenNI may read properties while it receives the frame
    const VirtualDeviceState state = device_.camera().state;
    if (device_.camera().frames->ready() && state != VirtualDeviceState::unplugged &&
        state != VirtualDeviceState::stalled)
      send(static_cast<int>(next.count()), state);
    last = next;
    lock.lock();
  }
}

void VirtualStream::send(int frame_index, VirtualDeviceState state)
{
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr)
    return;
  fill(*frame, frame_index);
  switch (state) {
    case VirtualDeviceState::corrupt:
      tear(*frame);
      break;
    case VirtualDeviceState::misshapen:
      misshape(*frame);
      break;
    case VirtualDeviceState::garbled:
      if (sensor_.sensorType == ONI_SENSOR_DEPTH)
        garble(*frame);
      break;
    case VirtualDeviceState::backwards:
      frame->timestamp = wrongTime(frame_index, frame->timestamp);
      break;
    case VirtualDeviceState::vanishing:
      if (sensor_.sensorType == ONI_SENSOR_DEPTH && ++sent_ == kVanishingFrame)
        device_.camera().pull();
      break;
    default:
      break;
  }
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

void VirtualStream::fill(OniFrame& frame, int frame_index)
{
  std::unique_lock<std::mutex> lock(mutex_);
  const OniVideoMode mode = mode_;
  const bool mirrored = mirrored_;
  lock.unlock();

  const bool is_depth = sensor_.sensorType == ONI_SENSOR_DEPTH;
  const RenderedFrames& frames = *device_.camera().frames;
  frame.sensorType = sensor_.sensorType;
  frame.frameIndex = frame_index;
  frame.timestamp = std::chrono::duration_cast<std::chrono::microseconds>(FramePeriod(frame_index)).count();
  frame.videoMode = mode;
  frame.width = mode.resolutionX;
  frame.height = mode.resolutionY;
  frame.croppingEnabled = FALSE;
  frame.cropOriginX = 0;
  frame.cropOriginY = 0;
  frame.stride = frame.width * static_cast<int>(is_depth ? sizeof(OniDepthPixel) : sizeof(Rgb));
  frame.dataSize = frame.height * frame.stride;

  const auto width = static_cast<int>(frames.model().width);
  if (is_depth) {
    auto* pixels = static_cast<OniDepthPixel*>(frame.data);
    scan(frames.depth(frame_index % frames.count(), device_.registered()).data(), width, mode, mirrored, pixels);
    // OpenNI's codec for recordings loses the last pixel where it ends a run of equal pixels.
    const std::size_t last = static_cast<std::size_t>(frame.width) * frame.height - 1;
    pixels[last] = pixels[last - 1];
  } else {
    scan(reinterpret_cast<const Rgb*>(frames.color().data()), width, mode, mirrored, static_cast<Rgb*>(frame.data));
  }
}

}  // namespace grasp_affordances
