#pragma once

#include "grasp_affordances/cloud.h"

#include <cstdint>

namespace grasp_affordances
{

/// Geometry and errors of the virtual sensor. docs/simulation.md gives the sources of the numbers.
///
/// A structured-light camera with focal length f and baseline b sees a surface at depth z with the disparity d = f b /
/// z. It matches a window of its pattern. The measured disparity has steps of q and noise of standard deviation sigma.
/// The reported depth is z = f b / d, so that errors grow with the square of depth: dz = z^2 / (f b) dd. At 1 m a step
/// is 2.9 mm; the standard deviation, with rounding to steps, is z^2 / (f b) sqrt(sigma^2 + q^2 / 12) = 1.6 mm.
struct SensorModel
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

}  // namespace grasp_affordances
