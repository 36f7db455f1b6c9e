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

/// Distance from the depth camera to the color camera, along +x of the optical frame, in metres, as in openni2_launch.
/// Both cameras have the same intrinsics, because OpenNI2 reports one field of view for both.
constexpr double kColorBaseline = 0.025;

/// Registers a depth image to the color camera: moves every pixel by the disparity between the cameras, to the nearest
/// pixel. If two pixels meet, the nearer surface is kept. Pixels that the depth camera does not see are 0.
std::vector<std::uint16_t> registeredDepth(const std::vector<std::uint16_t>& depth, const SensorModel& model);

/// The frames of a virtual device. A thread renders them. Safe to use from several threads.
class RenderedFrames
{
public:
  /// Frame 0 equals that of the tool `simulate`. @throw std::invalid_argument for an unknown scene.
  explicit RenderedFrames(const VirtualScene& scene);

  /// Ends the thread; it finishes at most the frame that it renders.
  ~RenderedFrames();

  RenderedFrames(const RenderedFrames&) = delete;
  RenderedFrames& operator=(const RenderedFrames&) = delete;

  const VirtualScene& scene() const { return scene_; }
  const SensorModel& model() const { return camera_.model(); }
  std::size_t count() const { return frames_.size(); }

  /// Whether all frames are rendered. The other methods that return frames need this.
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

  const DepthCamera camera_;
  const VirtualScene scene_;
  const View view_;
  std::vector<DepthFrame> frames_;
  std::vector<std::uint8_t> color_;
  std::atomic<bool> ready_{false};
  std::atomic<bool> closing_{false};
  std::thread thread_;
};

}  // namespace grasp_affordances
