#pragma once

#include "virtual_device/device_list.h"
#include "virtual_device/rendered_frames.h"

#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace grasp_affordances
{

/// A virtual camera while it is plugged in.
struct PluggedCamera
{
  VirtualDeviceSettings settings;  ///< without the state, which may change
  std::atomic<VirtualDeviceState> state;
  std::shared_ptr<const RenderedFrames> frames;
  std::function<void()> pull;  ///< unplugs it; may be called from any thread, once

  PluggedCamera(const VirtualDeviceSettings& camera_settings, std::shared_ptr<const RenderedFrames> camera_frames)
      : settings(camera_settings), state(camera_settings.state), frames(std::move(camera_frames))
  {
  }
};

/// The virtual cameras that are plugged in. A file lists them, and is read repeatedly. If it cannot be read, nothing
/// changes, and one line on stderr says so.
class VirtualBus : public std::enable_shared_from_this<VirtualBus>
{
public:
  using Event = std::function<void(const OniDeviceInfo&)>;

  /// @param list_file see parseDeviceList(); empty: one device, with the defaults of VirtualDeviceSettings
  /// @param connected, disconnected are called without a lock. The OniDeviceInfo stays valid as long as the bus.
  VirtualBus(std::string list_file, Event connected, Event disconnected);

  /// Reports the cameras that are plugged in according to the list. Then a thread watches the list.
  void start();

  /// Ends that thread, if possible. OpenNI holds a lock while it shuts its drivers down, and its callbacks wait for
  /// that lock. If the thread is just reporting a camera, waiting for it would be a deadlock. It is then detached, and
  /// keeps the bus alive until it ends.
  void stop();

  /// The camera with that URI that is plugged in; null if there is none.
  std::shared_ptr<PluggedCamera> find(const std::string& uri) const;

private:
  void watch();
  void update();
  std::vector<std::string> missing(const std::vector<VirtualDeviceSettings>& devices) const;
  void apply(const VirtualDeviceSettings& settings);
  void plugVanished();
  std::shared_ptr<const RenderedFrames> framesOf(const VirtualScene& scene);
  void plug(const VirtualDeviceSettings& settings);
  void unplug(const std::string& uri, const OniDeviceInfo& info);
  void complain(const std::string& message);

  const std::string list_file_;
  const Event connected_;
  const Event disconnected_;

  // Used by the updating thread only.
  std::string last_list_;
  std::vector<VirtualDeviceSettings> devices_;  // the entries of that list
  std::string last_complaint_;
  std::map<std::string, OniDeviceInfo> infos_;  // never erased: OpenNI keeps pointers to them
  std::vector<std::shared_ptr<const RenderedFrames>> frames_;

  mutable std::mutex mutex_;  // guards the members below
  std::map<std::string, std::shared_ptr<PluggedCamera>> plugged_;
  std::condition_variable change_;
  bool stopping_ = false;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace grasp_affordances
