#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Geometry and errors of the virtual sensor. docs/simulation.md gives the sources of the numbers.
///
/// A structured-light camera with focal length f and baseline b sees a surface at depth z with the disparity d = f b /
/// z. It matches a window of its pattern. The measured disparity has steps of q and noise of standard deviation sigma.
/// The reported depth is z = f b / d, so that errors grow with the square of depth: dz = z^2 / (f b) dd. At 1 m a step
/// is 2.9 mm; the standard deviation, with rounding to steps, is z^2 / (f b) sqrt(sigma^2 + q^2 / 12) = 1.6 mm.
struct XtionModel
{
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  PinholeIntrinsics intrinsics{575.8, 575.8, 319.5, 239.5};  ///< from OpenNI2's field of view
  double baseline = 0.075;          ///< m; the projector is beside the camera, on +x (Konolige and Mihelich)
  double disparity_step = 0.125;    ///< px (Konolige and Mihelich)
  double disparity_noise = 0.06;    ///< px, standard deviation before rounding to steps (fitted to recordings)
  std::uint32_t window_width = 9;   ///< px; the noise of pixels with overlapping windows is correlated
  std::uint32_t window_height = 4;  ///< px (fitted to recordings)
  double edge_jitter = 0.8;  ///< px, standard deviation of a depth edge's position along either axis (Nguyen et al.)
  double min_depth = 0.5;    ///< m; nearer surfaces are not measured
  double max_depth = 5.0;    ///< m, at most 65; farther surfaces are not measured
  bool exact = false;        ///< report the true depth of every surface that is not absorbing: no noise, no steps, no
                             ///< shadow of the projector, no missing pixels within the range

  /// One disparity step at that depth, in metres.
  double depthQuantum(double depth_m) const;
};

/// One measurement. Optical frame: x right, y down, z forward. Images are row-major.
struct Frame
{
  Cloud cloud;                       ///< organized, with intrinsics; each point is on its pixel's ray
  std::vector<std::uint16_t> depth;  ///< mm; 0 where nothing was measured (REP 118)
  std::vector<std::int32_t> parts;   ///< index into Scene::parts() of the measured part; -1 if nothing was measured
  std::vector<float> surface_depth;  ///< m, true depth of that part; next to a depth edge it is the depth at a pixel up
                                     ///< to 2 px away along either axis; NaN if nothing was measured
};

/// A virtual Asus Xtion. Safe to use from several threads.
class Xtion
{
public:
  /// @throw std::invalid_argument unless picture and window have pixels, the disparity step is positive, and
  /// 0 < min_depth < max_depth <= 65 m.
  explicit Xtion(const XtionModel& model = XtionModel());

  /// Captures a frame. It depends on the arguments only, not on the number of threads.
  Frame capture(const Scene& scene, const Eigen::Isometry3d& T_scene_camera, std::uint64_t seed) const;

  const XtionModel& model() const { return model_; }

private:
  XtionModel model_;
};

}  // namespace grasp_affordances
