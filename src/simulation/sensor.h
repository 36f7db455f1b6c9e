#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What the virtual sensor measures with, and how badly. docs/simulation.md says where the numbers come from.
///
/// A structured-light camera of focal length f and baseline b sees a surface at depth z with the disparity d = f b / z.
/// It matches a window of its pattern in steps q and with noise sigma, and reports z = f b / d, so that errors grow
/// with the square of depth: dz = z^2 / (f b) dd. At 1 m, a step is 2.9 mm and the standard deviation, rounding to
/// steps included, z^2 / (f b) sqrt(sigma^2 + q^2 / 12) = 1.6 mm.
struct XtionModel
{
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  PinholeIntrinsics intrinsics{575.8, 575.8, 319.5, 239.5};  ///< from the field of view that OpenNI2 reports
  double baseline = 0.075;          ///< m; the projector is beside the camera, on +x (Konolige and Mihelich)
  double disparity_step = 0.125;    ///< px (Konolige and Mihelich)
  double disparity_noise = 0.06;    ///< px, standard deviation before rounding to steps (fitted to recordings)
  std::uint32_t window_width = 9;   ///< px; the noise of pixels that share a part of their windows is correlated
  std::uint32_t window_height = 4;  ///< px (fitted to recordings)
  double edge_jitter = 0.8;  ///< px, standard deviation of a depth edge's place along either axis (Nguyen et al.)
  double min_depth = 0.5;    ///< m; nearer surfaces are not measured
  double max_depth = 5.0;    ///< m, at most 65; nor are farther ones
  bool exact = false;  ///< report the true depth of every surface but absorbing ones: no noise, no steps, no shadow of
                       ///< the projector, nothing missing within the range

  /// One disparity step at that depth, in metres.
  double depthQuantum(double depth_m) const;
};

/// One measurement. Optical frame: x right, y down, z forward. Images are row-major.
struct Frame
{
  Cloud cloud;                       ///< organized, with intrinsics; each point is on its pixel's ray
  std::vector<std::uint16_t> depth;  ///< mm; 0 where nothing was measured (REP 118)
  std::vector<std::int32_t> parts;   ///< index into Scene::parts() of what was measured; -1 for nothing
  std::vector<float> surface_depth;  ///< m, true depth of that part where it was hit, next to a depth edge up to 2 px
                                     ///< away along either axis; NaN for nothing
};

/// A virtual Asus Xtion. Safe to use from several threads.
class Xtion
{
public:
  /// @throw std::invalid_argument unless picture and window have pixels, the disparity step is positive, and
  /// 0 < min_depth < max_depth <= 65 m.
  explicit Xtion(const XtionModel& model = XtionModel());

  /// The frame depends on its arguments alone, whatever the number of threads.
  Frame capture(const Scene& scene, const Eigen::Isometry3d& T_scene_camera, std::uint64_t seed) const;

  const XtionModel& model() const { return model_; }

private:
  XtionModel model_;
};

}  // namespace grasp_affordances
