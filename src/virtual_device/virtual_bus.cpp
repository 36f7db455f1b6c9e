#include "virtual_device/virtual_bus.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

namespace grasp_affordances
{
namespace
{

constexpr std::chrono::milliseconds kReadingPeriod(20);
constexpr std::chrono::seconds kLongestStop(1);

std::optional<std::string> contents(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    return std::nullopt;
  return text.str();
}

OniDeviceInfo deviceInfo(const std::string& uri)
{
  OniDeviceInfo info = {};
  std::strncpy(info.uri, uri.c_str(), sizeof(info.uri) - 1);
  std::strncpy(info.vendor, "grasp_affordances", sizeof(info.vendor) - 1);
  std::strncpy(info.name, "Virtual Xtion", sizeof(info.name) - 1);
  return info;
}

}  // namespace

VirtualBus::VirtualBus(std::string list_file, Event connected, Event disconnected)
    : list_file_(std::move(list_file)), connected_(std::move(connected)), disconnected_(std::move(disconnected))
{
}

void VirtualBus::start()
{
  if (list_file_.empty()) {
    VirtualDeviceSettings only;
    only.uri = only.serial = "virtual/1";
    plug(only);
    return;
  }
  update();
  thread_ = std::thread([self = shared_from_this()] { self->watch(); });
}

void VirtualBus::stop()
{
  std::unique_lock<std::mutex> lock(mutex_);
  stopping_ = true;
  change_.notify_all();
  if (!thread_.joinable())
    return;
  const bool ended = change_.wait_for(lock, kLongestStop, [this] { return stopped_; });
  lock.unlock();
  if (ended)
    thread_.join();
  else
    thread_.detach();
}

std::shared_ptr<PluggedCamera> VirtualBus::find(const std::string& uri) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto camera = plugged_.find(uri);
  return camera == plugged_.end() ? nullptr : camera->second;
}

void VirtualBus::watch()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!change_.wait_for(lock, kReadingPeriod, [this] { return stopping_; })) {
    lock.unlock();
    update();
    lock.lock();
  }
  stopped_ = true;
  change_.notify_all();
}

void VirtualBus::update()
{
  const std::optional<std::string> list = contents(list_file_);
  if (!list) {
    complain("cannot be read");
    return;
  }
  if (list == last_list_) {
    plugVanished();
    return;
  }
  last_list_ = *list;
  try {
    devices_ = parseDeviceList(*list);
    last_complaint_.clear();
    for (const std::string& uri : missing(devices_))
      unplug(uri, infos_.at(uri));
    for (const VirtualDeviceSettings& settings : devices_)
      apply(settings);
  } catch (const std::exception& error) {
    complain(error.what());
  }
}

std::vector<std::string> VirtualBus::missing(const std::vector<VirtualDeviceSettings>& devices) const
{
  std::vector<std::string> uris;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& camera : plugged_) {
    const auto& uri = camera.first;
    if (std::none_of(devices.begin(), devices.end(), [&](const auto& device) { return device.uri == uri; }))
      uris.push_back(uri);
  }
  return uris;
}

void VirtualBus::apply(const VirtualDeviceSettings& settings)
{
  const bool wanted = settings.state != VirtualDeviceState::unplugged;
  const std::shared_ptr<PluggedCamera> camera = find(settings.uri);
  const bool same =
      camera && camera->settings.serial == settings.serial && camera->settings.scene == settings.scene && wanted;
  if (same) {
    camera->state = settings.state;
    return;
  }
  if (camera)
    unplug(settings.uri, infos_.at(settings.uri));
  if (wanted)
    plug(settings);
}

void VirtualBus::plugVanished()
{
  for (const VirtualDeviceSettings& settings : devices_) {
    if (settings.state == VirtualDeviceState::vanishing && !find(settings.uri))
      plug(settings);
  }
}

std::shared_ptr<const RenderedFrames> VirtualBus::framesOf(const VirtualScene& scene)
{
  const auto known = std::find_if(frames_.begin(), frames_.end(), [&](const auto& f) { return f->scene() == scene; });
  if (known != frames_.end())
    return *known;
  frames_.push_back(std::make_shared<RenderedFrames>(scene));
  return frames_.back();
}

void VirtualBus::plug(const VirtualDeviceSettings& settings)
{
  const OniDeviceInfo& info = infos_.emplace(settings.uri, deviceInfo(settings.uri)).first->second;
  const auto camera = std::make_shared<PluggedCamera>(settings, framesOf(settings.scene));
  camera->pull = [bus = weak_from_this(), uri = settings.uri, &info] {
    if (const auto self = bus.lock())
      self->unplug(uri, info);
  };
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_)
      return;
    plugged_[settings.uri] = camera;
  }
  connected_(info);
}

void VirtualBus::unplug(const std::string& uri, const OniDeviceInfo& info)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto camera = plugged_.find(uri);
    if (stopping_ || camera == plugged_.end())  // or it was unplugged meanwhile
      return;
    camera->second->state = VirtualDeviceState::unplugged;
    plugged_.erase(camera);
  }
  disconnected_(info);
}

void VirtualBus::complain(const std::string& message)
{
  if (message == last_complaint_)
    return;
  last_complaint_ = message;
  std::cerr << "virtual OpenNI2 devices: " << list_file_ << ": " << message << std::endl;
}

}  // namespace grasp_affordances
