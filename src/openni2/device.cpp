#include "openni2/device.h"

#include "openni2/device_error.h"
#include "openni2/device_id.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace grasp_affordances
{
namespace
{

openni::SensorType sensorType(Sensor sensor)
{
  return sensor == Sensor::depth ? openni::SENSOR_DEPTH : openni::SENSOR_COLOR;
}

std::string sensorName(Sensor sensor)
{
  return sensor == Sensor::depth ? "depth" : "color";
}

std::string serialNumber(const openni::Device& device)
{
  char serial[256] = {};
  int size = sizeof(serial) - 1;
  return device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size) == openni::STATUS_OK ? serial : "";
}

std::string serialNumberOf(const std::string& uri)
{
  openni::Device device;
  const bool opened = device.open(uri.c_str()) == openni::STATUS_OK;  // fails if another program uses the device
  return opened ? serialNumber(device) : "";
}

std::vector<openni::VideoMode> videoModes(const openni::VideoStream& stream)
{
  const openni::Array<openni::VideoMode>& modes = stream.getSensorInfo().getSupportedVideoModes();
  std::vector<openni::VideoMode> result;
  for (int i = 0; i < modes.getSize(); ++i) {
    result.push_back(modes[i]);
  }
  return result;
}

FieldOfView reportedFieldOfView(const openni::VideoStream& video)
{
  return {video.getHorizontalFieldOfView(), video.getVerticalFieldOfView()};
}

}  // namespace

Device::Device(const DeviceRequest& request) : runtime_(OpenNi2Runtime::get())
{
  try {
    open(request.id);
    if (isRecording()) {
      check(device_.getPlaybackControl()->setRepeatEnabled(false), "the recording cannot be played once");
    } else {
      const bool registers = device_.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
      if (request.registration && !registers) {
        throw DeviceError("the device does not register depth with color");
      }
      if (registers) {
        check(device_.setImageRegistrationMode(request.registration ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR
                                                                    : openni::IMAGE_REGISTRATION_OFF),
              "registration cannot be switched");
      }
    }
    openStream(Sensor::depth, request.depth_mode);
    if (request.color_mode) {
      openStream(Sensor::color, *request.color_mode);
    } else if (request.registration && device_.hasSensor(openni::SENSOR_COLOR)) {
      openni::VideoStream video;
      check(video.create(device_, openni::SENSOR_COLOR), uri_ + ": no color stream to ask for its field of view");
      stream(Sensor::color).field_of_view = reportedFieldOfView(video);
    }
  } catch (...) {
    close();
    throw;
  }
}

Device::~Device()
{
  close();
}

void Device::close()
{
  if (listens_) {
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    openni::OpenNI::removeDeviceStateChangedListener(this);
  }
  frame_.release();
  for (Stream& stream : streams_) {
    stream.video.stop();
  }
  if (device_.isValid() && isRecording()) {
    // The player's thread reads the list of streams without a lock. At the end of a recording it does so all the time.
    // When no stream runs, it finishes its frame and then sleeps 10 ms at a time. Only then streams may be destroyed.
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  for (Stream& stream : streams_) {
    stream.video.destroy();
  }
  device_.close();
}

void Device::open(const std::string& id)
{
  uri_ = isRecordingPath(id) ? id : deviceUri(id, runtime_->deviceUris(), serialNumberOf);
  check(device_.open(uri_.c_str()), uri_ + " cannot be opened");
  serial_ = serialNumber(device_);
  listens_ = true;
  check(openni::OpenNI::addDeviceDisconnectedListener(this), "OpenNI2 does not report devices");
  check(openni::OpenNI::addDeviceStateChangedListener(this), "OpenNI2 does not report devices");
  const std::vector<std::string> uris = runtime_->deviceUris();
  if (!isRecording() && std::find(uris.begin(), uris.end(), uri_) == uris.end()) {
    throw DeviceNotFound(uri_ + " was disconnected");  // before the listeners were added
  }
}

void Device::openStream(Sensor sensor, const FrameMode& mode)
{
  if (!device_.hasSensor(sensorType(sensor))) {
    throw DeviceError(uri_ + " has no " + sensorName(sensor) + " stream");
  }
  const std::string name = uri_ + ", " + sensorName(sensor);
  Stream& opened = stream(sensor);
  openni::VideoStream& video = opened.video;
  check(video.create(device_, sensorType(sensor)), name + ": no stream");
  if (!isRecording()) {
    check(video.setVideoMode(supportedVideoMode(name, sensorType(sensor), videoModes(video), mode)),
          name + ": mode " + frameModeWord(mode));
    video.setMirroringEnabled(false);  // a device without this setting does not mirror
  }
  const openni::VideoMode actual = video.getVideoMode();
  const FrameMode actual_mode{actual.getResolutionX(), actual.getResolutionY(), actual.getFps()};
  supportedVideoMode(name, sensorType(sensor), {actual}, actual_mode);  // throws if the format cannot be read
  opened.layout = {actual_mode.width, actual_mode.height, actual.getPixelFormat(), video.getMirroringEnabled()};
  opened.field_of_view = reportedFieldOfView(video);
}

FieldOfView Device::fieldOfView(Sensor sensor) const
{
  const std::optional<FieldOfView>& own = stream(sensor).field_of_view;
  return own ? *own : stream(Sensor::depth).field_of_view.value();
}

void Device::run(Sensor sensor, bool on)
{
  Stream& changed = stream(sensor);
  if (on && !changed.runs) {
    check(changed.video.start(), uri_ + ", " + sensorName(sensor) + ": the stream does not start");
  } else if (!on && changed.runs) {
    frame_.release();
    changed.video.stop();
  }
  changed.runs = on;
}

std::optional<DeviceFrame> Device::read(std::chrono::milliseconds timeout)
{
  frame_.release();
  std::vector<openni::VideoStream*> running;
  std::vector<Sensor> sensors;
  for (const Sensor sensor : {Sensor::depth, Sensor::color}) {
    if (runs(sensor)) {
      running.push_back(&stream(sensor).video);
      sensors.push_back(sensor);
    }
  }
  int ready = -1;
  const int count = static_cast<int>(running.size());
  const openni::Status status =
      openni::OpenNI::waitForAnyStream(running.data(), count, &ready, static_cast<int>(timeout.count()));
  if (status == openni::STATUS_TIME_OUT) {
    return std::nullopt;
  }
  check(status, uri_ + " cannot be waited for");
  check(running[ready]->readFrame(&frame_), uri_ + ": a frame cannot be read");

  const RawImage image{
      frame_.getData(),   static_cast<std::size_t>(frame_.getDataSize()),      frame_.getWidth(),
      frame_.getHeight(), static_cast<std::size_t>(frame_.getStrideInBytes()), frame_.getVideoMode().getPixelFormat()};
  return DeviceFrame{sensors[ready], image, isIntact(image, layout(sensors[ready])), frame_.getTimestamp()};
}

void Device::onDeviceDisconnected(const openni::DeviceInfo* info)
{
  if (uri_ == info->getUri()) {
    connected_ = false;
  }
}

void Device::onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state)
{
  if (uri_ == info->getUri() && state == openni::DEVICE_STATE_EOF) {
    at_end_ = true;
  }
}

}  // namespace grasp_affordances
