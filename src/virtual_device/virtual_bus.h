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

/// A camera from its plugging in to its unplugging.
struct PluggedCamera
{
  VirtualDeviceSettings settings;  ///< but for the state
  std::atomic<VirtualDeviceState> state;
  std::shared_ptr<const RenderedFrames> frames;
  std::function<void()> pull;  ///< unplugs it; from any thread, once

  PluggedCamera(const VirtualDeviceSettings& camera_settings, std::shared_ptr<const RenderedFrames> camera_frames)
      : settings(camera_settings), state(camera_settings.state), frames(std::move(camera_frames))
  {
  }
};

/// What virtual cameras are plugged in, as a file says that is read again and again. A list that cannot be read changes
/// nothing and is said on stderr, once.
class VirtualBus : public std::enable_shared_from_this<VirtualBus>
{
public:
  using Event = std::function<void(const OniDeviceInfo&)>;

  /// @param list_file see parseDeviceList(); empty: one device, with the defaults of VirtualDeviceSettings
  /// @param connected, disconnected are called with no lock held. The information stays valid as long as the bus.
  VirtualBus(std::string list_file, Event connected, Event disconnected);

  /// Reports the cameras that the list says are plugged in, then watches it in a thread of its own.
  void start();

  /// Ends that thread. OpenNI shuts its drivers down with a lock held that its own callbacks wait for: a thread that is
  /// about to report a camera at this very moment cannot be waited for. It is left behind, and holds the bus.
  void stop();

  /// The camera that is plugged in under that URI; empty if there is none.
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

  // Of the thread that updates.
  std::string last_list_;
  std::vector<VirtualDeviceSettings> devices_;  // of that list
  std::string last_complaint_;
  std::map<std::string, OniDeviceInfo> infos_;  // OpenNI keeps pointers to them: none is ever erased
  std::vector<std::shared_ptr<const RenderedFrames>> frames_;

  mutable std::mutex mutex_;  // of what follows
  std::map<std::string, std::shared_ptr<PluggedCamera>> plugged_;
  std::condition_variable change_;
  bool stopping_ = false;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace grasp_affordances
