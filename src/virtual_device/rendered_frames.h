#pragma once

#include "simulation/scene.h"
#include "simulation/sensor.h"
#include "virtual_device/device_list.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace grasp_affordances
{

/// Where the color camera is beside the depth camera, whose intrinsics it shares: OpenNI2 reports one field of view for
/// both. On +x of the optical frame, in metres; openni2_launch has the same number.
constexpr double kColorBaseline = 0.025;

/// What the color camera would measure: every pixel of a depth image moved by the disparity between the cameras to the
/// nearest pixel there; the nearer surface wins, and what the depth camera does not see stays 0.
std::vector<std::uint16_t> registeredDepth(const std::vector<std::uint16_t>& depth, const XtionModel& model);

/// The frames of a virtual device, rendered in a thread of their own. Safe to use from several threads.
class RenderedFrames
{
public:
  /// Frame 0 is that of the tool `simulate`. @throw std::invalid_argument for an unknown scene.
  explicit RenderedFrames(const VirtualScene& scene);

  /// Ends the thread, after at most one more frame.
  ~RenderedFrames();

  RenderedFrames(const RenderedFrames&) = delete;
  RenderedFrames& operator=(const RenderedFrames&) = delete;

  const VirtualScene& scene() const { return scene_; }
  const XtionModel& model() const { return xtion_.model(); }
  std::size_t count() const { return frames_.size(); }

  /// Whether all are rendered: before that there is none.
  bool ready() const { return ready_; }

  const std::vector<std::uint16_t>& depth(std::size_t n, bool registered) const
  {
    return registered ? frames_[n].registered_depth : frames_[n].depth;
  }

  const std::vector<std::uint8_t>& color() const { return color_; }

private:
  struct DepthFrame
  {
    std::vector<std::uint16_t> depth;
    std::vector<std::uint16_t> registered_depth;
  };

  void render();

  const Xtion xtion_;
  const VirtualScene scene_;
  const View view_;
  std::vector<DepthFrame> frames_;
  std::vector<std::uint8_t> color_;
  std::atomic<bool> ready_{false};
  std::atomic<bool> closing_{false};
  std::thread thread_;
};

}  // namespace grasp_affordances
