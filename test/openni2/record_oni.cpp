// record_oni FILE.oni FRAMES [URI]: records depth frames of a device.

#include <OpenNI.h>

#include <iostream>
#include <string>

namespace
{

int failed(const char* what)
{
  std::cerr << what << ": " << openni::OpenNI::getExtendedError() << '\n';
  return 1;
}

int record(const char* file, int frames, const char* uri)
{
  openni::Device device;
  openni::VideoStream depth;
  openni::Recorder recorder;
  if (device.open(uri) != openni::STATUS_OK || depth.create(device, openni::SENSOR_DEPTH) != openni::STATUS_OK)
    return failed(uri == openni::ANY_DEVICE ? "no device" : uri);
  depth.setMirroringEnabled(false);
  if (recorder.create(file) != openni::STATUS_OK || recorder.attach(depth) != openni::STATUS_OK ||
      recorder.start() != openni::STATUS_OK || depth.start() != openni::STATUS_OK)
    return failed(file);
  for (int n = 0; n < frames; ++n) {
    constexpr int timeout_ms = 10000;
    openni::VideoStream* streams[] = {&depth};
    openni::VideoFrameRef frame;
    int ready = 0;
    if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, timeout_ms) != openni::STATUS_OK ||
        depth.readFrame(&frame) != openni::STATUS_OK)
      return failed("no frame");
  }
  depth.stop();  // before the recorder, lest OpenNI2 deadlock over a frame that comes meanwhile
  recorder.stop();
  recorder.destroy();
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 3) {
    std::cerr << "record_oni FILE.oni FRAMES [URI]\n";
    return 2;
  }
  if (openni::OpenNI::initialize() != openni::STATUS_OK)
    return failed("OpenNI2");
  const int status = record(argv[1], std::stoi(argv[2]), argc > 3 ? argv[3] : openni::ANY_DEVICE);
  openni::OpenNI::shutdown();
  return status;
}
